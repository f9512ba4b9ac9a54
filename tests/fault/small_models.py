"""Small models for the tests of batches: each file another one, the same for the same number."""


def square_grid(number, side):
    """A webxml text: one patch, side x side squares of two triangles, lifted differently for each number."""
    points = [f'<v p="{x} {y} {(x * y * (number % 97 + 1)) % 7 / 7:.6f}"/>' for y in range(side + 1)
              for x in range(side + 1)]
    facets = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            b = a + side + 1
            facets += [f'<f v="{a} {a + 1} {b + 1}"/>', f'<f v="{a} {b + 1} {b}"/>']
    newline = "\n"
    return (f'<?xml version="1.0"?>\n<step-assembly root="id1">\n<product id="id1" name="N{number}" shape="id2"/>\n'
            f'<shape id="id2" unit="mm 0.001" shell="id3"/>\n<shell id="id3">\n<verts>\n{newline.join(points)}\n'
            f'</verts>\n<facets>\n{newline.join(facets)}\n</facets>\n</shell>\n</step-assembly>\n')


def broken(text):
    """One file of each class that cannot be read, by name, as bytes."""
    levels = "".join(f'<shape id="s{k}"><child ref="s{k + 1}" xform="{PLACE}"/><child ref="s{k + 1}" xform="{PLACE}"/>'
                     "</shape>\n" for k in range(40))
    return {
        "empty": b"",
        "truncated": text[:len(text) // 2].encode(),
        "garbage": bytes((7 * k * k + 13 * k) % 256 for k in range(4096)),
        "other": b'<svg xmlns="http://www.w3.org/2000/svg"/>',
        "index": text.replace('<f v="0 1', '<f v="0 99999999', 1).encode(),
        "number": text.replace('<v p="0 0', '<v p="0 nan', 1).encode(),
        "doctype": text.replace("<step-assembly", "<!DOCTYPE x [<!ENTITY a SYSTEM '/etc/passwd'>]>\n<step-assembly",
                                1).encode(),
        "outside": b'<step-assembly root="p"><product id="p" shape="s"/><shape id="s" shell="h"/>'
                   b'<shell id="h" href="../../outside.xml"/></step-assembly>',
        "missing": b'<step-assembly root="p"><product id="p" shape="s"/><shape id="s" shell="h"/>'
                   b'<shell id="h" href="nowhere.xml"/></step-assembly>',
        "cycle": f'<step-assembly root="p"><product id="p" shape="s"/><shape id="s"><child ref="s" xform="{PLACE}"/>'
                 "</shape></step-assembly>".encode(),
        "bomb": ('<step-assembly root="p"><product id="p" shape="s0"/>\n' + levels + '<shape id="s40" shell="id3"/>\n'
                 + text[text.index("<shell"):]).encode(),
    }


PLACE = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
