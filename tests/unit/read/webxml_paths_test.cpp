// The scan of plain bodies and tinyxml2 must give the same model, whatever the threads.

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "nlohmann/json.hpp"
#include "support/catch.hpp"
#include "support/packed.hpp"
#include "support/shared.hpp"
#include "unit/read/webxml_text.hpp"

using namespace meshcontour;
using namespace webxml_text;
namespace fs = std::filesystem;

namespace {

Model read_as(const fs::path& file, const std::string& bytes, bool careful, unsigned threads) {
  ReadOptions options;
  options.threads = threads;
  const detail::InputFolder folder(file.parent_path());
  const detail::ReadContext context{file.string(), options, &folder};
  return careful ? detail::read_webxml_carefully(bytes, context) : detail::read_webxml(bytes, context);
}

std::string whole(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string outcome(const fs::path& file, const std::string& bytes, bool careful, unsigned threads) {
  try {
    const Model model = read_as(file, bytes, careful, threads);
    return fingerprint(model) + texts(model.diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
}

std::string outcome_of_file(const fs::path& file) {
  try {
    const Model model = read_model(file);
    return fingerprint(model) + texts(model.diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
}

void check_paths(const fs::path& file, const std::string& bytes) {
  INFO(file.string());
  const std::string usual = outcome(file, bytes, false, 1);
  CHECK((outcome(file, bytes, false, 4) == usual));
  CHECK((outcome(file, bytes, true, 1) == usual));
  CHECK((outcome(file, bytes, true, 4) == usual));
}

}  // namespace

TEST_CASE("webxml paths: agree on the samples", "[read]") {
  const fs::path data = MESHCONTOUR_DATA_DIR;
  for (const char* name : {"stud.xml", "assembly/index.xml", "assembly/shell_id32.xml"}) {
    check_paths(data / name, whole(data / name));
  }
}

TEST_CASE("webxml paths: agree when one body of many is unusual", "[read]") {
  const std::string text = whole(fs::path(MESHCONTOUR_DATA_DIR) / "stud.xml");
  const Model usual = read(text);
  const std::string unusual =
      replaced(text, "<f v=\"102 103 137\"", "<!-- </facets> --><f v=\"102 103 137\"");
  CHECK((fingerprint(read(unusual)) == fingerprint(usual)));
  const std::string harmless = replaced(text, "<f v=\"102 103 137\"", "<!-- --><f v=\"102 103 137\"");
  CHECK((fingerprint(read(harmless)) == fingerprint(usual)));
  check_paths("stud.xml", replaced(text, "<f v=\"102 103 137\"", "<x/><f v=\"102 103 137\""));
  check_paths("stud.xml", replaced(text, "<f v=\"102 103 137\"", "<f v=\"102 103 237\" a=\"\""));
  check_paths("stud.xml", replaced(text, "<f v=\"102 103 137\"", "<f v=\"102 103 238\""));
}

TEST_CASE("webxml paths: a large model reads alike from memory and part by part from its file", "[read]") {
  std::string shells, ids;
  const std::string text = whole(fs::path(MESHCONTOUR_DATA_DIR) / "stud.xml");
  const std::string stud = text.substr(text.find("<verts>"), text.find("</shell>") - text.find("<verts>"));
  for (int k = 0; k < 9; ++k) {
    ids += " s" + std::to_string(k);
    shells += shell(k == 4 ? replaced(stud, "<f v=\"102 103 137\"", "<x/><f v=\"102 103 137\"") : stud,
                    "s" + std::to_string(k));
  }
  const fs::path file =
      fs::temp_directory_path() / ("meshcontour_large_" + std::to_string(::getpid()) + ".xml");
  for (const std::string& model :
       {document(shells, ids), replaced(document(shells, ids), "</step-assembly>", "</step>")}) {
    std::ofstream(file, std::ios::binary) << model;
    INFO(file.string());
    CHECK((outcome_of_file(file) == outcome(file, model, false, 2)));
    check_paths(file, model);
  }
  fs::remove(file);
}

TEST_CASE("webxml paths: agree on every model, and on what an independent reader counts", "[read][shared]") {
  MESHCONTOUR_NEEDS_SHARED("models/expected.json")
  const auto expected = nlohmann::json::parse(whole(shared_dir() / "models/expected.json"));
  REQUIRE(expected.size() >= 50);
  for (const auto& [name, counts] : expected.items()) {
    const auto bytes = unpacked(shared_dir() / "models" / name);
    if (!bytes) continue;  // no tool to unpack it with
    INFO(name);
    const fs::path file = shared_dir() / "models" / name;
    const Model model = read_as(file, *bytes, false, 1);
    validate(model);
    CHECK((fingerprint(read_as(file, *bytes, true, 1)) == fingerprint(model)));
    std::size_t points = 0, triangles = 0, patches = 0;
    std::vector<std::string> per_patch;
    for (const Shell& shell : model.shells) {
      points += shell.points.size();
      triangles += shell.triangles.size();
      patches += shell.patches.size();
      for (std::size_t p = 0; p < shell.patches.size(); ++p) {
        per_patch.push_back(shell.id + ' ' + std::to_string(p + 1) + ' ' +
                            std::to_string(shell.patches[p].triangle_count));
      }
    }
    CHECK(model.shells.size() == counts["shells"]);
    CHECK(model.instances.size() == counts["instances"]);
    CHECK(points == counts["vertices"]);
    CHECK(triangles == counts["triangles"]);
    CHECK(patches == counts["patches"]);
    std::vector<std::string> listed;
    for (const auto& patch : counts["per_patch"]) {
      listed.push_back(patch[0].get<std::string>() + ' ' + std::to_string(patch[1].get<int>()) + ' ' +
                       std::to_string(patch[2].get<int>()));
    }
    std::ranges::sort(listed);
    std::ranges::sort(per_patch);
    CHECK(per_patch == listed);
  }
}

TEST_CASE("webxml: instances lie where the CAD model has them", "[read][shared]") {
  const std::string name =
      GENERATE("as1_tu_203.m", "dm1_id_214.m", "dm1_oc_214.m-srr", "brl_mapped_items.m", "moteus_xt60.m");
  MESHCONTOUR_NEEDS_SHARED(("models/" + name + ".xml"))
  const auto packed = unpacked(shared_dir() / "models" / (name + ".truth.json"));
  if (!packed) return;
  const auto truth = nlohmann::json::parse(*packed);
  const Model model = read_model(shared_dir() / "models" / (name + ".xml"));
  REQUIRE(model.instances.size() == truth["instance_list"].size());
  std::vector<bool> met(model.instances.size());
  for (const auto& listed : truth["instance_list"]) {
    Eigen::Matrix4d placement;
    for (int k = 0; k < 16; ++k) placement(k) = listed["xform"][static_cast<std::size_t>(k)].get<double>();
    bool found = false;
    for (std::size_t i = 0; i < met.size() && !found; ++i) {
      const Instance& instance = model.instances[i];
      if (met[i] || model.shells[instance.shell].id != listed["shell"].get<std::string>()) continue;
      found = (instance.placement.matrix() - placement).cwiseAbs().maxCoeff() < 1e-9;
      if (found) met[i] = true;
    }
    CHECK(found);
  }
}

TEST_CASE("webxml paths: agree on hostile files", "[read][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(shared_dir() / "hostile")) {
    if (entry.path().extension() == ".xml") files.insert(entry.path());
  }
  REQUIRE(files.size() > 150);
  for (const fs::path& file : files) {
    if (file.filename() == "d09_million_instances.xml") continue;  // a million instances four times over
    check_paths(file, whole(file));
  }
}
