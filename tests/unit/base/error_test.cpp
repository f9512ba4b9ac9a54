#include "meshcontour/error.hpp"

#include "support/catch.hpp"

using namespace meshcontour;

TEST_CASE("printable: control bytes and broken UTF-8 become visible", "[base]") {
  CHECK(printable("a\x1b[31mb\n") == "a\\x1b[31mb\\x0a");
  CHECK(printable("caf\xc3\xa9") == "caf\xc3\xa9");
  CHECK(printable("caf\xe9!") == "caf\xef\xbf\xbd!");
  CHECK(printable("\xc0\xaf") == "\xef\xbf\xbd\xef\xbf\xbd");  // overlong '/'
  CHECK(printable("\xc2\x9b") == "\xef\xbf\xbd");              // C1 control, an escape to some terminals
}

TEST_CASE("printable: a long text is cut", "[base]") {
  CHECK(printable(std::string(300, 'x'), 10) == "xxxxxxxxxx...");
}

TEST_CASE("Error: the message names file, line and element", "[base][error]") {
  const Error error(ErrorCode::BadData, "index 99, 4 vertices", {"a.xml", 17, 0, "f"});
  CHECK(std::string(error.what()) == "a.xml:17: f: index 99, 4 vertices");
  CHECK(static_cast<int>(error.code()) == 65);
  CHECK(std::string(Error(ErrorCode::Usage, "plain").what()) == "plain");
}

TEST_CASE("Diagnostic: one line with its count", "[base][error]") {
  const Diagnostic diagnostic{Diagnostic::Severity::Warning, "triangle left out", {"a.xml", 3, 0, ""}, 2};
  CHECK(diagnostic.text() == "a.xml:3: warning: triangle left out (2 times)");
}
