#include "read/format.hpp"

#include <vector>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

const std::vector<Format> kTable = {
    {"Alpha",
     {"a"},
     [](std::string_view head, std::uint64_t) { return head[0] == '<' ? Match::Sure : Match::No; },
     nullptr},
    {"Beta",
     {"b", "bb"},
     [](std::string_view head, std::uint64_t) { return head[0] == '1' ? Match::Possible : Match::No; },
     nullptr},
    {"Gamma",
     {"c"},
     [](std::string_view head, std::uint64_t) { return head[0] != '<' ? Match::Possible : Match::No; },
     nullptr},
    {"Epsilon",
     {"e"},
     [](std::string_view head, std::uint64_t) { return head[0] == '?' ? Match::IfNamed : Match::No; },
     nullptr},
    {"Delta",
     {"d"},
     [](std::string_view, std::uint64_t size) { return size == 84 ? Match::Sure : Match::No; },
     nullptr},
};

std::string_view detected(std::string_view head, std::string_view name, std::uint64_t size = 9) {
  return detect_format(head, size, name, kTable).name;
}

}  // namespace

TEST_CASE("detect_format: a signature wins over the extension", "[read]") {
  CHECK(detected("<x>", "m.a") == "Alpha");
  CHECK(detected("<x>", "m.b") == "Alpha");
  CHECK(detected("<x>", "m") == "Alpha");
  CHECK(detected("1", "m.b", 84) == "Delta");
}

TEST_CASE("detect_format: between possible formats the extension decides", "[read]") {
  CHECK(detected("1", "dir.x/m.BB") == "Beta");
  CHECK(detected("1", "m.c") == "Gamma");
  CHECK(detected("2", "m.b") == "Gamma");  // the only one possible
  CHECK(detected("?", "m.e") == "Epsilon");
  CHECK(detected("?", "m.x") == "Gamma");
}

TEST_CASE("detect_format: what fits nothing is refused in words", "[read][error]") {
  CHECK_THROWS_WITH(detected("1", "m.zzz"), "m.zzz: not a known format (Alpha, Beta, Gamma, Epsilon, Delta)");
  CHECK_THROWS_WITH(detect_format("x", 1, "m.a", std::span(kTable).first(1)),
                    "m.a: not Alpha: the content is something else");
  CHECK_THROWS_WITH(detected("", "m.a"), "m.a: empty file");
}
