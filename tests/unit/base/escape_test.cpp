#include "base/escape.hpp"

#include <limits>

#include "support/catch.hpp"

using namespace meshcontour::detail;

TEST_CASE("json_quoted: controls, quotes and broken UTF-8", "[base]") {
  CHECK(json_quoted("a\"b\\c\n\x01\x7f") == R"("a\"b\\c\u000a\u0001\u007f")");
  CHECK(json_quoted("\xe2\x80\xa8\xc3\xa9\xf0\x9f\x98\x80") == "\"\\u2028\xc3\xa9\xf0\x9f\x98\x80\"");
  CHECK(json_quoted("\xed\xa0\x80") == "\"\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\"");  // a surrogate
}

TEST_CASE("JsonNumber: shortest, or null", "[base]") {
  const auto text = [](double value) { return fmt::format("{}", JsonNumber{value}); };
  CHECK(text(0.1) == "0.1");
  CHECK(text(1e300) == "1e+300");
  CHECK(text(std::numeric_limits<double>::quiet_NaN()) == "null");
  CHECK(text(-std::numeric_limits<double>::infinity()) == "null");
}

TEST_CASE("xml_escaped: markup, line breaks and characters that XML does not know", "[base]") {
  CHECK(xml_escaped("<a b='c' d=\"e\">&") == "&lt;a b=&apos;c&apos; d=&quot;e&quot;&gt;&amp;");
  CHECK(xml_escaped("x\ny\x01\x1b\xff") == "x&#10;y\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
  CHECK(xml_escaped("\xef\xbf\xbe\xc3\xa9") == "\xef\xbf\xbd\xc3\xa9");
}

TEST_CASE("one_word: never empty, never two", "[base]") {
  CHECK(one_word("a b\tc") == "a_b_c");
  CHECK(one_word("") == "_");
  CHECK(one_word("\xc2\xa0#\\") == "___");  // a no-break space
}
