#include "base/text_cursor.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

TEST_CASE("TextCursor: the message names file, line, column and word", "[base][error]") {
  TextCursor in("v 1 2\n x", "a.net");
  in.word();
  in.number();
  in.number();
  CHECK_THROWS_WITH(in.number(), "a.net:2:2: expected a finite number, found 'x'");
}

TEST_CASE("TextCursor: words end at blanks, line ends of every kind and comments", "[base]") {
  TextCursor in("\xEF\xBB\xBFone\ttwo # no\r\nthree\rfour#x\n\n  ", "f", '#');
  CHECK(in.word() == "one");
  CHECK(in.peek() == "two");
  CHECK(in.word() == "two");
  CHECK(in.at_line_end());
  CHECK(in.word() == "three");
  CHECK(in.spot().line == 2);
  CHECK(in.at_line_end());
  CHECK(in.word() == "four");
  CHECK(in.spot().line == 3);
  CHECK(in.at_end());
  CHECK(in.peek().empty());
  CHECK_THROWS_WITH(in.word(), Catch::Contains("f:5") && Catch::Contains("end of the file"));
}

TEST_CASE("TextCursor: the rest of a line stops before its comment and takes its end", "[base]") {
  TextCursor in("g  a name  # why\r\nnext\n\nlast", "f", '#');
  CHECK(in.word() == "g");
  CHECK(in.rest_of_line() == "a name");
  CHECK(in.rest_of_line() == "next");
  CHECK(in.rest_of_line().empty());
  CHECK(in.rest_of_line() == "last");
  CHECK(in.at_end());
  CHECK(in.remaining() == 0);
}

TEST_CASE("TextCursor: a line that goes on too long is an error", "[base][error]") {
  TextCursor in("1 2\n3", "f");
  in.number();
  CHECK_THROWS_WITH(in.expect_line_end(), "f:1:3: expected the end of the line, found '2'");
  in.number();
  CHECK_NOTHROW(in.expect_line_end());
  CHECK(in.number() == 3);
  CHECK_NOTHROW(in.expect_line_end());
}

TEST_CASE("TextCursor: integers and indices are checked for their range", "[base][error]") {
  const std::string word =
      GENERATE("-1", "4", "4294967298", "18446744073709551618", "2.0", "+2", "2e0", "0x2", "2;", "");
  TextCursor in(word, "f");
  CHECK_THROWS_AS(in.index(4), Error);
  CHECK_THROWS_AS(in.integer(0, 3), Error);
  CHECK(TextCursor("003", "f").index(4) == 3);
  CHECK(TextCursor("-7", "f").integer(-7, 7) == -7);
}

TEST_CASE("TextCursor: an expected word must come", "[base][error]") {
  TextCursor in("OFF 3", "f");
  CHECK_NOTHROW(in.expect("OFF"));
  CHECK_THROWS_WITH(in.expect("4"), "f:1:5: expected '4', found '3'");
  in.skip_to(100);
  CHECK_THROWS_WITH(in.expect("4"), Catch::Contains("found the end of the file"));
}

TEST_CASE("parse_number: whole finite decimal words only", "[base]") {
  CHECK(parse_number("4.93054498004026e-014") == 4.93054498004026e-14);
  CHECK(parse_number("+1.5") == 1.5);
  CHECK(parse_number(".5") == 0.5);
  CHECK(parse_number("1.") == 1.0);
  CHECK(std::signbit(*parse_number("-0")));
  CHECK(parse_number("1e-310") == 1e-310);
  const std::string bad =
      GENERATE("", "+", "-", ".", "+-1", "++1", "nan", "inf", "-INFINITY", "1.#IND", "1.#QNAN", "0x1", "1d0",
               "1e", "1e+", "1,5", "1abc", " 1", "1 ", "1e400", "-1e400", "1e99999999999999999999");
  CHECK_FALSE(parse_number(bad));
}

TEST_CASE("parse_number: too small is zero, too large is none, however it is written", "[base]") {
  const std::string zeros(400, '0');
  CHECK(parse_number("1e-400") == 0.0);
  CHECK(parse_number("-1e-99999999999999999999") == 0.0);
  CHECK(parse_number("0." + zeros + "1") == 0.0);
  CHECK(parse_number("0." + zeros + "1e+2") == 0.0);
  CHECK(parse_number("0." + zeros + "1e401") == 1.0);
  CHECK(parse_number("1" + zeros + "e-400") == 1.0);
  CHECK_FALSE(parse_number("1" + zeros));
  CHECK_FALSE(parse_number("1" + zeros + "e-5"));
  CHECK_FALSE(parse_number("-1" + zeros + ".5"));
}
