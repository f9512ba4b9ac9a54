// A turntable view of the page's models: glTF of the shape that meshcontour itself writes (one buffer, tightly packed
// vertices, 32-bit indices), drawn with WebGL. Names of the file are only compared or shown as text.
"use strict";
(() => {
  const dialog = document.getElementById("viewer"), canvas = document.getElementById("canvas");
  const title = document.getElementById("viewer-title"), note = document.getElementById("viewer-note");
  const spin = document.getElementById("spin"), layers = [...dialog.querySelectorAll("[data-layer]")];
  const FOV = 0.5, START = { turn: -0.7, tilt: 0.5, zoom: 1, x: 0, y: 0 };
  let gl = null, programs = null, model = null, camera = { ...START }, queued = false, last = 0;

  // --- Matrices: columns one after the other, as in glTF.
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  function times(a, b) {
    const out = new Array(16).fill(0);
    for (let c = 0; c < 4; ++c) for (let r = 0; r < 4; ++r) for (let k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    return out;
  }
  const moved = (m, p) => [0, 1, 2].map(r => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]);

  // --- The file.
  function parse(base64) {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    const view = new DataView(bytes.buffer), length = view.getUint32(12, true);
    return { json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))), buffer: bytes.buffer, start: 28 + length };
  }
  function values(file, number, Type, components) {
    const accessor = file.json.accessors[number], offset = file.json.bufferViews[accessor.bufferView].byteOffset || 0;
    return new Type(file.buffer, file.start + offset + (accessor.byteOffset || 0), accessor.count * components);
  }
  const display = c => Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));

  // All primitives of a mesh in one set of buffers.
  function load(file, mesh) {
    const parts = mesh.primitives.map(p => ({
      p, positions: values(file, p.attributes.POSITION, Float32Array, 3), indices: values(file, p.indices, Uint32Array, 1),
      normals: "NORMAL" in p.attributes ? values(file, p.attributes.NORMAL, Float32Array, 3) : null,
      bounds: file.json.accessors[p.attributes.POSITION], material: file.json.materials[p.material] }));
    const vertices = parts.reduce((sum, part) => sum + part.positions.length / 3, 0);
    const data = { positions: new Float32Array(3 * vertices), normals: new Float32Array(3 * vertices),
      colors: new Uint8Array(4 * vertices), indices: new Uint32Array(parts.reduce((sum, part) => sum + part.indices.length, 0)) };
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    let vertex = 0, index = 0;
    for (const { positions, normals, indices, bounds, material } of parts) {
      data.positions.set(positions, 3 * vertex);
      if (normals) data.normals.set(normals, 3 * vertex);
      const color = material.pbrMetallicRoughness.baseColorFactor.map(display);
      for (let v = vertex; v < vertex + positions.length / 3; ++v) data.colors.set(color, 4 * v);
      for (let i = 0; i < indices.length; ++i) data.indices[index++] = vertex + indices[i];
      vertex += positions.length / 3;
      for (let a = 0; a < 3; ++a) { low[a] = Math.min(low[a], bounds.min[a]); high[a] = Math.max(high[a], bounds.max[a]); }
    }
    const lines = parts[0].p.mode === 1;
    return { lines, layer: lines ? parts[0].material.name : "mesh", count: index, low, high, data, buffers: null };
  }

  // Draws are nodes with a mesh; the model is drawn about the middle of its box, which keeps single precision exact.
  function build(base64) {
    const file = parse(base64), meshes = (file.json.meshes || []).map(mesh => load(file, mesh)), draws = [];
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const open = file.json.scenes[0].nodes.map(node => [node, identity]);
    while (open.length > 0) {
      const [number, above] = open.pop(), node = file.json.nodes[number], place = times(above, node.matrix || identity);
      for (const child of node.children || []) open.push([child, place]);
      if (!("mesh" in node)) continue;
      const mesh = meshes[node.mesh];
      draws.push({ mesh, place });
      for (let corner = 0; corner < 8; ++corner) {
        const p = moved(place, [0, 1, 2].map(a => (corner >> a & 1 ? mesh.high[a] : mesh.low[a])));
        for (let a = 0; a < 3; ++a) { low[a] = Math.min(low[a], p[a]); high[a] = Math.max(high[a], p[a]); }
      }
    }
    const radius = Math.hypot(...[0, 1, 2].map(a => high[a] - low[a])) / 2 || 1;
    const scale = 1 / radius;  // to a sphere of radius 1
    const centre = [0, 1, 2].map(a => (low[a] + high[a]) / 2);
    const recentred = [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, ...centre.map(c => -c * scale), 1];
    for (const draw of draws) draw.place = times(recentred, draw.place);
    const order = ["mesh", "edges", "curves", "annotations"];
    draws.sort((a, b) => order.indexOf(a.mesh.layer) - order.indexOf(b.mesh.layer));
    return { draws, meshes };
  }

  // --- WebGL.
  const VERTEX = `attribute vec3 position, normal; attribute vec4 color; uniform mat4 view, place; uniform float lines;
    varying vec4 shade; varying vec3 turned;
    void main() {
      gl_Position = view * (place * vec4(position, 1.0));
      gl_Position.z -= lines * 0.0004 * gl_Position.w;  // lines lie on the faces, and curves on edges
      turned = mat3(place) * normal; shade = color; }`;
  const FRAGMENT = `precision highp float; varying vec4 shade; varying vec3 turned; uniform vec3 eye; uniform float lines, light;
    void main() {
      vec3 n = normalize(turned);
      float lit = lines > 0.0 ? 1.0 : 0.3 + 0.5 * abs(dot(n, eye)) + 0.2 * abs(n.y);
      gl_FragColor = vec4(mix(shade.rgb * lit, vec3(1.0), lines > 0.0 ? light : 0.0), 1.0); }`;
  function start() {
    gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    if (!gl || !gl.getExtension("OES_element_index_uint")) { gl = null; return false; }
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source); gl.compileShader(shader); gl.attachShader(program, shader);
    }
    ["position", "normal", "color"].forEach((name, i) => { gl.bindAttribLocation(program, i, name); gl.enableVertexAttribArray(i); });
    gl.linkProgram(program); gl.useProgram(program);
    programs = Object.fromEntries(["view", "place", "lines", "eye", "light"].map(name => [name, gl.getUniformLocation(program, name)]));
    gl.enable(gl.DEPTH_TEST); gl.depthFunc(gl.LEQUAL);
    return true;
  }
  function buffer(target, data) {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made); gl.bufferData(target, data, gl.STATIC_DRAW);
    return made;
  }
  function release() {
    for (const mesh of model ? model.meshes : []) Object.values(mesh.buffers || {}).forEach(b => gl.deleteBuffer(b));
    model = null;
  }
  function bind(mesh) {
    mesh.buffers ||= { positions: buffer(gl.ARRAY_BUFFER, mesh.data.positions), normals: buffer(gl.ARRAY_BUFFER, mesh.data.normals),
      colors: buffer(gl.ARRAY_BUFFER, mesh.data.colors), indices: buffer(gl.ELEMENT_ARRAY_BUFFER, mesh.data.indices) };
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers.positions); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers.normals); gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers.colors); gl.vertexAttribPointer(2, 4, gl.UNSIGNED_BYTE, true, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.buffers.indices);
  }

  // --- The picture.
  function view(width, height) {
    const { turn, tilt, zoom, x, y } = camera, c = Math.cos(turn), s = Math.sin(turn), d = Math.cos(tilt), e = Math.sin(tilt);
    const right = [c, 0, s], up = [s * e, d, -c * e], back = [-s * d, e, c * d];
    const distance = 1.05 / Math.sin(FOV / 2) / zoom, near = Math.max(distance - 2, distance / 1000), far = distance + 2;
    const look = [0, 1, 2].flatMap(i => [right[i], up[i], back[i], 0]).concat([x / zoom, y / zoom, -distance, 1]);
    const f = 1 / Math.tan(FOV / 2), narrow = Math.min(width / height, 1);  // the whole sphere shows in a narrow window too
    const projection = [f * height * narrow / width, 0, 0, 0, 0, f * narrow, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
    return { matrix: times(projection, look), eye: back };
  }
  function draw() {
    if (!gl || !model) return;
    const density = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * density));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * density));
    gl.viewport(0, 0, canvas.width, canvas.height);
    const ground = getComputedStyle(canvas).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(c => c / 255);
    gl.clearColor(...ground, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { matrix, eye } = view(canvas.width, canvas.height);
    gl.uniformMatrix4fv(programs.view, false, matrix); gl.uniform3fv(programs.eye, eye);
    gl.uniform1f(programs.light, ground[0] < 0.5 ? 0.55 : 0);  // dark lines would not show on a dark ground
    const shown = new Set(layers.filter(box => box.checked).map(box => box.dataset.layer));
    for (const { mesh, place } of model.draws) {
      if (!shown.has(mesh.layer)) continue;
      bind(mesh);
      gl.uniformMatrix4fv(programs.place, false, place); gl.uniform1f(programs.lines, mesh.lines ? (mesh.layer === "edges" ? 1 : 1.5) : 0);
      gl.drawElements(mesh.lines ? gl.LINES : gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    }
  }
  const spinning = () => spin.getAttribute("aria-pressed") === "true";
  function request() {
    if (queued) return;
    queued = true;
    requestAnimationFrame(now => {
      queued = false;
      if (spinning()) camera.turn += Math.min(now - last, 100) * 0.0006;
      last = now;
      draw();
      if (spinning() && dialog.open) request();
    });
  }
  function setSpin(on) { spin.setAttribute("aria-pressed", on); last = performance.now(); request(); }
  function change(turn, tilt, zoom, x = 0, y = 0) {
    camera.turn += turn; camera.tilt = Math.max(-1.57, Math.min(1.57, camera.tilt + tilt));
    camera.zoom = Math.max(0.2, Math.min(200, camera.zoom * zoom)); camera.x += x; camera.y += y;
    request();
  }

  // --- What the user does.
  function show(button) {
    title.textContent = button.dataset.name;
    note.textContent = "";
    dialog.showModal();
    if (!gl && !start()) { note.textContent = "This browser does not offer WebGL, which the 3D view needs."; return; }
    release();
    try {
      model = build(document.getElementById(button.dataset.model).textContent);
      const present = new Set(model.draws.map(d => d.mesh.layer));
      for (const box of layers) box.parentNode.hidden = !present.has(box.dataset.layer);
    } catch (fault) {
      note.textContent = `The model cannot be shown: ${fault.message}`;
      return;
    }
    camera = { ...START };
    setSpin(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    canvas.focus();
  }
  const KEYS = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 1.15], "=": [0, 0, 1.15], "-": [0, 0, 1 / 1.15] };
  canvas.addEventListener("keydown", event => {
    if (event.key === "Home") { camera = { ...START }; request(); }
    else if (KEYS[event.key]) { setSpin(false); change(...KEYS[event.key]); }
    else return;
    event.preventDefault();
  });
  const pointers = new Map();
  canvas.addEventListener("pointerdown", event => { canvas.setPointerCapture(event.pointerId); pointers.set(event.pointerId, event); setSpin(false); });
  canvas.addEventListener("pointermove", event => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const x = event.clientX - before.clientX, y = event.clientY - before.clientY, size = canvas.clientHeight;
    const other = [...pointers.values()].find(p => p.pointerId !== event.pointerId);
    const apart = p => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY) || 1;
    if (other) change(0, 0, apart(event) / apart(before), x / size, -y / size);
    else if (event.shiftKey || event.buttons & 2) change(0, 0, 1, 2 * x / size, -2 * y / size);
    else change(x / 150, y / 150, 1);
    pointers.set(event.pointerId, event);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => { event.preventDefault(); change(0, 0, Math.exp(-event.deltaY * 0.0015)); }, { passive: false });
  canvas.addEventListener("webglcontextlost", event => { event.preventDefault(); gl = null; model = null; note.textContent = "The graphics context was lost; close the view and open it again."; });
  spin.addEventListener("click", () => setSpin(!spinning()));
  for (const box of layers) box.addEventListener("input", request);
  new ResizeObserver(request).observe(canvas);
  dialog.addEventListener("close", () => { setSpin(false); pointers.clear(); });
  document.getElementById("close").addEventListener("click", () => dialog.close());
  for (const button of document.querySelectorAll("button[data-model]")) button.addEventListener("click", () => show(button));
})();
