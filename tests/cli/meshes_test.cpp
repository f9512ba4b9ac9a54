#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";
const std::string kTetrahedron =
    "OFF\n5 4 0\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n9 9 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

}  // namespace

TEST_CASE("lines: spanning trees and paths as pictures, OBJ and VRML", "[cli]") {
  const TemporaryFolder folder;
  write_file(folder / "a.off", kTetrahedron);
  const ProgramOptions here{.folder = folder.path().string()};
  const std::vector<std::string> whole = {"a.off", "--patches-from", "none", "-v"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), whole.begin(), whole.end());
    const ProgramResult result = run_program(more, here);
    INFO(result.errors);
    CHECK(result.code == 0);
    return result.errors;
  };
  CHECK_THAT(run({"-o", "tree.wrl", "-o", "tree.obj", "--obj", "tree"}),
             Contains("spanning trees of 1 patches, length 6"));
  CHECK(file_text(folder / "tree.obj") ==
        "o shell_mesh_patch_1_tree\nv 0 0 0\nv 1 0 0\nl 1 2\nv 0 0 0\nv 0 2 0\nl 3 4\nv 0 0 0\nv 0 0 3\nl 5 "
        "6\n");
  run({"--layers", "tree", "-o", "same.obj"});
  CHECK(file_text(folder / "same.obj") == file_text(folder / "tree.obj"));
  run({"--layers", "mesh,tree,edges", "-o", "other.obj"});
  CHECK(file_text(folder / "other.obj") != file_text(folder / "tree.obj"));
  CHECK_THAT(file_text(folder / "tree.wrl"),
             Contains("IndexedLineSet") && Contains("0, 1, -1,\n2, 3, -1,\n4, 5, -1,\n"));
  CHECK_THAT(run({"--path-from", "1", "--path-to", "3", "-o", "way.wrl", "--wrl", "path", "-o", "way.png",
                  "--layers", "mesh,tree,path", "--size", "64x48"}),
             Contains("path from vertex 1 to 3: 1 edges, length 3.16227766"));
  CHECK_THAT(file_text(folder / "way.wrl"), Contains("1 0 0,\n0 0 3,\n"));
  CHECK(file_text(folder / "way.png").starts_with("\x89PNG"));
}

TEST_CASE("lines: ends of a path that are wrong are refused", "[cli][error]") {
  const TemporaryFolder folder;
  write_file(folder / "a.off", kTetrahedron);
  write_file(folder / "two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 5 5\n6 5 5\n5 6 5\n3 0 1 2\n3 3 4 5\n");
  const auto refusal = [&](std::vector<std::string> arguments) {
    const ProgramResult result = run_program(arguments, {.folder = folder.path().string()});
    CHECK(result.code == 64);
    return result.errors;
  };
  CHECK_THAT(refusal({"a.off", "--path-from", "1"}), Contains("a path needs --path-from and --path-to"));
  CHECK_THAT(refusal({"a.off", "-o", "a.png", "--layers", "path"}),
             Contains("a path needs --path-from and --path-to"));
  CHECK_THAT(refusal({"a.off", "--path-from", "0", "--path-to", "5"}),
             Contains("there is no vertex 5: the shell has 5, numbered from 0"));
  CHECK_THAT(refusal({"a.off", "--path-from", "0", "--path-to", "4"}), Contains("no triangle uses vertex 4"));
  CHECK_THAT(refusal({"a.off", "--path-from", "0", "--path-to", "-1"}), Contains("--path-to"));
  CHECK_THAT(refusal({"a.off", "--path-from", "0", "--path-to", "1e9"}), Contains("--path-to"));
  CHECK_THAT(refusal({"two.off", "--path-from", "0", "--path-to", "3"}),
             Contains("no edges join the vertices 0 and 3"));
  CHECK_THAT(refusal({"a.off", "--path-from", "0", "--path-to", "1", "--shell", "x"}),
             Contains("no shell 'x'"));
}

TEST_CASE("mesh files: hostile counts in headers are refused at once, without the memory that they ask for",
          "[cli][error]") {
  const TemporaryFolder folder;
  const std::string facet(50, '\0');
  std::string stl(80, ' ');
  write_file(folder / "count.stl", stl + "\xFF\xFF\xFF\xFF" + facet);
  write_file(
      folder / "vertices.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n");
  write_file(folder / "faces.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
  write_file(folder / "vertices.off", "OFF\n2000000000 1 0\n");
  write_file(folder / "faces.off", "OFF\n1 2000000000 0\n0 0 0\n");
  write_file(folder / "negative.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n");
  write_file(folder / "huge.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999999999999\n");
  write_file(folder / "negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n");
  write_file(folder / "huge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967297\n");
  write_file(folder / "huge.net", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 4294967294\n");
  write_file(folder / "negative.net", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 -2\n");
  for (const std::string& name : folder.names()) {
    INFO(name);
    const ProgramResult result = run_program({name, "-o", "-", "--format", "csv", "--max-memory", "100MB"},
                                             {.folder = folder.path().string()});
    CHECK(result.code == 65);
    CHECK(result.output.empty());
    CHECK_THAT(result.errors, Contains(name));
    CHECK(count_lines(result.errors) == 1);
  }
}
