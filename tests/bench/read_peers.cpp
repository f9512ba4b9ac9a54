// Reading webxml: ours beside pugixml, rapidxml and tinyxml2, each with std::from_chars into flat arrays, in
// turn, processor time. What they read is compared before the clock starts.
//
// usage: bench_read_peers MODEL.xml [rounds]

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#if __has_include(<rapidxml/rapidxml.hpp>)
#define MESHCONTOUR_HAS_RAPIDXML
#include <rapidxml/rapidxml.hpp>
#endif

#include "bench/bench.hpp"
#include "meshcontour/read.hpp"

using namespace meshcontour;

namespace {

struct Flat {
  std::vector<double> points, normals;
  std::vector<Index> triangles;
};

struct Answer {
  std::size_t points = 0, normals = 0;
  std::uint64_t triangle_sum = 0;
  double point_sum = 0;
};

bool agree(const Answer& a, const Answer& b) {
  return a.points == b.points && a.normals == b.normals && a.triangle_sum == b.triangle_sum &&
         std::abs(a.point_sum - b.point_sum) <= 1e-9 * (1 + std::abs(a.point_sum));
}

Answer answer_of(const Flat& flat) {
  return {flat.points.size(), flat.normals.size(),
          std::accumulate(flat.triangles.begin(), flat.triangles.end(), std::uint64_t{0}),
          std::accumulate(flat.points.begin(), flat.points.end(), 0.0)};
}

Answer answer_of(const Model& model) {
  Answer answer;
  for (const Shell& shell : model.shells) {
    answer.points += 3 * shell.points.size();
    answer.normals += 3 * shell.corner_normals.size();
    for (const Triangle& t : shell.triangles) answer.triangle_sum += std::uint64_t{t[0]} + t[1] + t[2];
    for (const Point& p : shell.points) answer.point_sum += p.sum();
  }
  return answer;
}

template <class Number>
void add_numbers(std::string_view text, std::vector<Number>& numbers) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    Number number{};
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc()) return;
    numbers.push_back(number);
    for (at = stop; at != end && *at == ' ';) ++at;
  }
}

struct PugiNode {
  pugi::xml_node node;
  explicit operator bool() const { return !node.empty(); }
  std::string_view name() const { return node.name(); }
  std::string_view attribute(const char* key) const { return node.attribute(key).value(); }
  PugiNode child() const { return {node.first_child()}; }
  PugiNode next() const { return {node.next_sibling()}; }
};

#ifdef MESHCONTOUR_HAS_RAPIDXML
struct RapidNode {
  const rapidxml::xml_node<>* node;
  explicit operator bool() const { return node != nullptr; }
  std::string_view name() const { return {node->name(), node->name_size()}; }
  std::string_view attribute(const char* key) const {
    const auto* found = node->first_attribute(key);
    return found == nullptr ? std::string_view() : std::string_view(found->value(), found->value_size());
  }
  RapidNode child() const { return {node->first_node()}; }
  RapidNode next() const { return {node->next_sibling()}; }
};
#endif

struct TinyNode {
  const tinyxml2::XMLElement* node;
  explicit operator bool() const { return node != nullptr; }
  std::string_view name() const { return node->Name(); }
  std::string_view attribute(const char* key) const {
    const char* found = node->Attribute(key);
    return found == nullptr ? std::string_view() : found;
  }
  TinyNode child() const { return {node->FirstChildElement()}; }
  TinyNode next() const { return {node->NextSiblingElement()}; }
};

template <class Node>
void collect(Node node, Flat& flat) {
  for (; node; node = node.next()) {
    const std::string_view name = node.name();
    if (name == "v") add_numbers(node.attribute("p"), flat.points);
    if (name == "n") add_numbers(node.attribute("d"), flat.normals);
    if (name == "f") add_numbers(node.attribute("v"), flat.triangles);
    collect(node.child(), flat);
  }
}

std::vector<char> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<char> bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

Flat read_pugixml(const std::string& path) {
  std::vector<char> bytes = bytes_of(path);
  pugi::xml_document document;
  document.load_buffer_inplace(bytes.data(), bytes.size(), pugi::parse_minimal);
  Flat flat;
  collect(PugiNode{document.first_child()}, flat);
  return flat;
}

#ifdef MESHCONTOUR_HAS_RAPIDXML
Flat read_rapidxml(const std::string& path) {
  std::vector<char> bytes = bytes_of(path);
  bytes.push_back(0);
  rapidxml::xml_document<> document;
  document.parse<rapidxml::parse_fastest>(bytes.data());
  Flat flat;
  collect(RapidNode{document.first_node()}, flat);
  return flat;
}
#endif

Flat read_tinyxml2(const std::string& path) {
  const std::vector<char> bytes = bytes_of(path);
  tinyxml2::XMLDocument document;
  document.Parse(bytes.data(), bytes.size());
  Flat flat;
  collect(TinyNode{document.RootElement()}, flat);
  return flat;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_read_peers MODEL.xml [rounds]\n");
    return 64;
  }
  const std::string path = argv[1];
  std::vector<std::pair<std::string, Flat (*)(const std::string&)>> readers = {{"pugixml", read_pugixml},
#ifdef MESHCONTOUR_HAS_RAPIDXML
                                                                               {"rapidxml", read_rapidxml},
#endif
                                                                               {"tinyxml2", read_tinyxml2}};
  ReadOptions options;
  options.threads = 1;
  const Answer expected = answer_of(read_model(std::filesystem::path(path), options));
  std::vector<bench::Contender> contenders = {
      {"meshcontour", [&] { read_model(std::filesystem::path(path), options); }}};
  for (const auto& [name, read] : readers) {
    if (!agree(answer_of(read(path)), expected)) {
      fmt::print("{}: the answers differ\n", name);
      return EXIT_FAILURE;
    }
    contenders.push_back({name, [&path, reader = read] { reader(path); }});
  }
  bench::alternate(contenders, argc > 2 ? std::atoi(argv[2]) : 5);
  fmt::print("| reader | milliseconds | time / ours |\n|---|---:|---:|\n");
  for (const bench::Contender& contender : contenders) {
    fmt::print("| {} | {:.1f} | {:.2f} |\n", contender.name, 1000 * contender.median(),
               contender.median() / contenders[0].median());
  }
}
