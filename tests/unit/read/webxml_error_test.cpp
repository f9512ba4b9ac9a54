#include <random>
#include <string>

#include "support/catch.hpp"
#include "unit/read/webxml_text.hpp"

using namespace meshcontour;
using namespace webxml_text;
using Catch::Contains;

namespace {

// What reading gives: the message of the error, or "ok" and the warnings.
std::string outcome(std::string_view text) {
  try {
    const Model model = read(text);
    validate(model);
    return "ok\n" + texts(model.diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
}

struct Broken {
  const char* from;
  const char* to;
  const char* message;
};

}  // namespace

TEST_CASE("webxml: every broken form is refused with its line", "[read][error]") {
  const Broken broken = GENERATE(values<Broken>({
      {"</verts>", "</vert>", "m.xml:11:1: </vert> where </verts> must come"},
      {"</step-assembly>\n", "", "the file ends inside <step-assembly>"},
      {"</step-assembly>\n", "</step-assembly>\n<x/>", "m.xml:26:1: a second document element"},
      {"</step-assembly>\n", "</step-assembly>\nx", "m.xml:26:1: text after the document element"},
      {"<step-assembly", "<!DOCTYPE x>\n<step-assembly", "m.xml:2:1: a DOCTYPE is refused"},
      {"<product", "<!-- a -- b -->\n<product", "m.xml:3:8: '--' inside a comment"},
      {"<product", "<!-- a\n<product", "a comment that does not end"},
      {"<product", "<![CDATA[ a\n<product", "a CDATA section that does not end"},
      {"<product", "<?xml version=\"1.0\"?>\n<product", "an XML declaration that is not at the start"},
      {"<product", "<?p", "a processing instruction that does not end"},
      {"name=\"T\" shape=\"id2\"", "name=\"T", "m.xml:4:1: '<' in an attribute value"},
      {"name=\"T\"", "name=T", "an attribute value without quotes"},
      {"name=\"T\"", "name", "attribute 'name' has no value"},
      {"name=\"T\"", "name=\"T\"id=\"4\"", "a blank is missing before an attribute"},
      {"name=\"T\"", "id=\"T\"", "m.xml:3:1: attribute 'id' is given twice"},
      {"name=\"T\"", "name=\"&nbsp;\"", "m.xml:3:25: entity '&nbsp;' is not declared"},
      {"name=\"T\"", "name=\"&#0;\"", "a reference to an illegal character"},
      {"name=\"T\"", "name=\"&#xD800;\"", "a reference to an illegal character"},
      {"name=\"T\"", "name=\"a & b\"", "'&' that starts no reference"},
      {"name=\"T\"", "name=\"\x01\"", "m.xml:3:25: an illegal control character"},
      {"step-assembly root", "svg root", "m.xml:2:1: not a webxml file: the document element is <svg>"},
      {"UTF-8", "Shift_JIS", "m.xml:1: encoding 'Shift_JIS' is not supported"},
      {"</verts>", "</verts>\n<verts>\n</verts>", "a second <verts>"},
      {"0 2 3", "0 2 4", "m.xml:18: shell id3, f: v: index 4, 4 vertices"},
      {"0 2 3", "0 2 -1", "m.xml:18: shell id3, f: v: '-1' is not an index"},
      {"0 2 3", "0 2 18446744073709551618", "v: index 18446744073709551618, 4 vertices"},
      {"0 2 3", "0 2 2.0", "v: '2.0' is not an index"},
      {"0 2 3", "0 2", "v needs 3 indices, found 2"},
      {"0 2 3", "0 2 3 1", "v needs 3 indices, found 4"},
      {"0 2 3", "0,2,3", "v needs 3 indices, found 1"},
      {"v=\"0 2 3\"", "", "m.xml:18: shell id3, f: attribute v is missing"},
      {"1 1 0", "1 nan 0", "m.xml:9: shell id3, v: p: 'nan' is not a finite number"},
      {"1 1 0", "1 1e999 0", "p: '1e999' is not a finite number"},
      {"1 1 0", "1 0x1 0", "p: '0x1' is not a finite number"},
      {"1 1 0", "1 1e101 0", "p: 1e+101 is beyond 1e+100"},
      {"1 1 0", "1 1", "p needs 3 numbers, found 2"},
      {"p=\"1 1 0\"", "", "m.xml:9: shell id3, v: attribute p is missing"},
      {"<verts>\n<v p=\"0 0 0\"/>\n<v p=\"1 0 0\"/>\n<v p=\"1 1 0\"/>\n<v p=\"0 1 0\"/>\n</verts>\n", "",
       "v: index 0, 0 vertices"},
  }));
  const std::string text = replaced(square(), broken.from, broken.to);
  CHECK_THAT(outcome(text), Contains(broken.message));
}

TEST_CASE("webxml: what can be mended is a warning with its line", "[read][error]") {
  const Broken mended = GENERATE(values<Broken>({
      {"<product", "<meta/>\n<product", "m.xml:3: meta: warning: does not belong here and is left out"},
      {"<f v=\"0 1 2\"", "<v p=\"9 9 9\"/>\n<f v=\"0 1 2\"",
       "m.xml:13: shell id3: warning: <v> does not belong here"},
      {"<n d=\"0 0 1\"/>", "", "m.xml:13: shell id3, f: warning: 2 corner normals where 3 belong"},
      {"<n d=\"0 0 1\"/>", "<n d=\"0 0\"/>",
       "m.xml:14: shell id3, n: warning: a normal without three numbers"},
      {"name=\"T\"", "name=\"caf\xe9\"", "m.xml:3: warning: byte 0xe9 is not UTF-8"},
      {"1 1 0", "1 1e30 0", "m.xml:9: shell id3, v: warning: p: 1e+30 is far"},
      {"shell=\"id3\"", "shell=\"id3 id9\"", "m.xml:4: warning: 'id9' names no shell and is left out"},
      {"unit=\"mm 0.001000\"", "unit=\"parsec\"", "m.xml:4: shape id2: warning: unit 'parsec' is not known"},
      {"<product", "text <product", "m.xml:3: note: text between elements is not read"},
  }));
  const std::string text = replaced(square(), mended.from, mended.to);
  CHECK_THAT(outcome(text), Catch::StartsWith("ok\n") && Contains(mended.message));
}

TEST_CASE("webxml: legal but unusual XML reads as the usual form does", "[read]") {
  const std::string usual = fingerprint(read(square()));
  const auto [from, to, message] = GENERATE(values<Broken>({
      {"<product", "<!-- <product/> --><?pi x?>\n<product", ""},
      {"<v p=\"1 0 0\"/>", "<v p='1 0 0'></v>", ""},
      {"<v p=\"1 0 0\"/>", "<v\tp\n=\r\n\"\t1  0\n0 \" />", ""},
      {"<v p=\"1 0 0\"/>", "<v p=\"&#49; 0 &#x30;\"/>", ""},
      {"<v p=\"1 0 0\"/>", "<!-- </verts> --><v p=\"1 0 0\" tol=\"a &gt; b/>\"/>", ""},
      {"<v p=\"1 0 0\"/>", "<v p=\"+1.0 .0 0e5\"/>", ""},
      {"<f v=\"0 2 3\"", "<![CDATA[<f v=\"0 1 3\"/></facets>]]><f v=\"0 2 3\"", ""},
      {"<f v=\"0 2 3\"", "<f mat=\"3\" v=\"0 2 3\"", ""},
      {"<f v=\"0 2 3\"", "<f v=\"00 002 3\"", ""},
      {"</verts>", "</verts  >", ""},
      {"encoding=\"UTF-8\"", "", ""},
      {"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", "", ""},
      {"<?xml version", "\xEF\xBB\xBF<?xml version", ""},
      {"name=\"T\"", "name=\"&#84;\"", ""},
      {"<step-assembly root", "<step-assembly xmlns=\"urn:x\" xmlns:q=\"urn:y\" root", ""},
  }));
  const std::string text = replaced(square(), from, to);
  CHECK((fingerprint(read(text)) == usual));
  CHECK(message == std::string());
}

TEST_CASE("webxml: line ends and encodings make no difference", "[read]") {
  const std::string text = square(), usual = fingerprint(read(text));
  const auto with_ends = [&](const std::string& end) {
    std::string out;
    for (const char c : text) out += c == '\n' ? end : std::string(1, c);
    return out;
  };
  CHECK((fingerprint(read(with_ends("\r\n"))) == usual));
  CHECK((fingerprint(read(with_ends("\r"))) == usual));
  CHECK((fingerprint(read(with_ends(""))) == usual));
  CHECK_THROWS_WITH(read(replaced(with_ends("\r"), "0 2 3", "0 2 9")), Contains("m.xml:18: shell id3, f"));
  CHECK_THROWS_WITH(read(replaced(with_ends("\r\n"), "0 2 3", "0 2 9")), Contains("m.xml:18: shell id3, f"));
  std::string little = "\xFF\xFE", big;
  for (const char c : text) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  CHECK((fingerprint(read(little)) == usual));
  CHECK((fingerprint(read(big)) == usual));
  const std::string latin = replaced(replaced(text, "UTF-8", "ISO-8859-1"), "name=\"T\"", "name=\"caf\xe9\"");
  CHECK(read(latin).name == "caf\xc3\xa9");
  CHECK(read(latin).diagnostics.empty());
}

TEST_CASE("webxml: every prefix of a file gives a model or an error", "[read][error]") {
  const std::string text = square();
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const std::string prefix = text.substr(0, length);
    const std::string result = outcome(std::string_view(prefix.data(), prefix.size()));
    const bool whole = length + 1 >= text.size();
    if ((result == "ok\n") != whole) FAIL("prefix of " << length << " bytes: " << result);
  }
}

TEST_CASE("webxml: flipped bits give a model or an error", "[read][error]") {
  const std::string text = document(shell(kPoints + kSquare) +
                                    "<annotation id=\"n\"><polyline><p l=\"0 0 0\"/>"
                                    "<p l=\"1 2 3\"/></polyline></annotation>");
  std::mt19937 random(1);
  std::size_t good = 0;
  constexpr std::size_t kTrials = 4000;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    std::string flipped = text;
    const std::size_t flips = 1 + random() % 3;
    for (std::size_t k = 0; k < flips; ++k)
      flipped[random() % text.size()] ^= static_cast<char>(1u << random() % 8);
    good += outcome(flipped).starts_with("ok");
  }
  CHECK(good > kTrials / 10);
  CHECK(good < kTrials * 9 / 10);
}

TEST_CASE("webxml: ten thousand warnings of one kind are one line", "[read]") {
  std::string ids = "id3";
  for (int k = 0; k < 10'000; ++k) ids += " x" + std::to_string(k);
  const Model model = read(document(shell(kPoints + kSquare), ids));
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].count == 10'000);
}

TEST_CASE("webxml: what the reader holds of a file may end anywhere", "[read][error]") {
  const std::string text =
      replaced(document(shell(kPoints + kSquare) +
                        "<annotation id=\"n&#x41;\" note='a > b'><polyline><p l=\"0 0 0\"/><p "
                        "l=\"1 2 3\"/></polyline></annotation><?pi some words?>\r\n"),
               "<shape", "<![CDATA[ ]] > ]]>text &amp; more<!-- - --><shape");
  const std::string usual = outcome(text), prolog = text.substr(0, text.find("<step"));
  const std::string broken = replaced(text, "1 2 3", "1 2 <");
  const std::string names_line = outcome(broken);
  for (std::size_t shift = 0; shift < text.size(); ++shift) {
    constexpr std::size_t kWindow = std::size_t{256} << 10;
    const std::string padding = "<!--" + std::string(kWindow - prolog.size() - shift, '.') + "-->";
    const auto padded = [&](const std::string& whole) {
      return prolog + padding + whole.substr(prolog.size());
    };
    if (outcome(padded(text)) != usual) FAIL("shift " << shift << ": " << outcome(padded(text)));
    if (outcome(padded(broken)) != names_line) FAIL("shift " << shift << ": " << outcome(padded(broken)));
  }
}

TEST_CASE("webxml: long attributes are read, absurd ones refused", "[read][error]") {
  const std::string name(3'000'000, 'N');
  CHECK((read(replaced(square(), "name=\"T\"", "name=\"" + name + "\"")).name == name));
  const std::string absurd(70'000'000, 'N');
  CHECK_THROWS_WITH(read(replaced(square(), "name=\"T\"", "name=\"" + absurd + "\"")),
                    Contains("m.xml:3:1: markup of more than 67108864 bytes"));
}

TEST_CASE("webxml: many attributes and deep nesting stay cheap", "[read][error]") {
  std::string attributes;
  for (int k = 0; k < 50'000; ++k) attributes += " a" + std::to_string(k) + "=\"1\"";
  CHECK_THROWS_WITH(read(replaced(square(), " name=\"T\"", attributes)),
                    Contains("m.xml:3:") && Contains("more than 256 attributes"));
  std::string nested;
  for (int k = 0; k < 100'000; ++k) nested += "<x>";
  CHECK_THROWS_WITH(read(replaced(square(), "<product", nested + "<product")),
                    Contains("nested deeper than 64"));
  CHECK_THROWS_WITH(read(replaced(square(), "<f v", nested + "<f v")), Contains("nested deeper than 64"));
}
