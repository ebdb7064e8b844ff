#include "engine/text/printable.h"

#include <doctest/doctest.h>

#include "engine/text/diagnostic.h"

using namespace weft::text;

TEST_CASE("what could move a cursor, turn text or begin a line is shown as its number") {
  CHECK(printable("plain, 'quoted' and \\n: \xc3\xa4 \xe2\x82\xac \xf0\x9f\x8e\xa8") ==
        "plain, 'quoted' and \\n: \xc3\xa4 \xe2\x82\xac \xf0\x9f\x8e\xa8");
  CHECK(printable("a\nb\r\tc") == "a\\nb\\r\\tc");
  CHECK(printable(std::string_view("\x1b[2J\x7f\0\x07", 7)) == "\\x1b[2J\\x7f\\x00\\x07");
  CHECK(printable("\xc2\x9b"
                  "31m \xc2\x80 \xc2\x9f \xc2\xa0") == "\\u{9b}31m \\u{80} \\u{9f} \xc2\xa0");
  CHECK(printable("\u202a\u202e\u2066\u2069\u2028\u2029\u200f") ==
        "\\u{202a}\\u{202e}\\u{2066}\\u{2069}\\u{2028}\\u{2029}\\u{200f}");
  CHECK(printable("\u2027\u202f\u2065\u206a") == "\u2027\u202f\u2065\u206a");  // their neighbors
}

TEST_CASE("bytes that are no UTF-8 are shown one by one") {
  CHECK(printable("\xff\xfe") == "\\xff\\xfe");
  CHECK(printable("\xc3(") == "\\xc3(");
  CHECK(printable("\xe2\x82") == "\\xe2\\x82");                             // ends early
  CHECK(printable("\xc0\x9b\xe0\x82\x9b") == "\\xc0\\x9b\\xe0\\x82\\x9b");  // CSI, too long
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");                    // a surrogate
  CHECK(printable("\xf5\x80\x80\x80") == "\\xf5\\x80\\x80\\x80");
}

TEST_CASE("of ten million bytes the beginning and the end are printed") {
  const std::string text = shortened("unknown key \"" + std::string(10'485'760, 'x') + "\" in a pass");
  CHECK(text.starts_with("unknown key \"xxx"));
  CHECK(text.find("… (10485784 bytes) …") != std::string::npos);
  CHECK(text.ends_with("xxx\" in a pass"));
  CHECK(text.size() < 400);
  CHECK(shortened(std::string(400, 'x')) == std::string(400, 'x'));
  std::string umlauts(600, '\xc3');
  for (std::size_t i = 1; i < umlauts.size(); i += 2) umlauts[i] = '\xa4';
  CHECK(printable(shortened("a" + umlauts)).find("\\x") == std::string::npos);  // cut between characters
}

TEST_CASE("no field of a diagnostic can forge another one") {
  const std::string forged = "x\nother.json:1:1: error[W001]: forged\x1b[A\u202e";
  Diagnostic d{
      .severity = Severity::error, .code = Code::unknownPassType, .message = forged, .place = {forged, 2, 3}};
  d.pass = d.resource = d.expected = d.found = d.hint = forged;
  const std::string text = format(d);
  CHECK(std::count(text.begin(), text.end(), '\n') == 5);  // one line per field
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(text.find("\u202e") == std::string::npos);
  CHECK(text.find("\n    pass: x\\nother.json:1:1: error[W001]: forged\\x1b[A\\u{202e}\n") !=
        std::string::npos);
  CHECK(text.starts_with("x\\nother.json"));
}

TEST_CASE("one thing and several") {
  CHECK(counted(1, "case") == "1 case");
  CHECK(counted(0, "case") == "0 cases");
  CHECK(counted(2, "pass") == "2 passes");
  CHECK(counted(12, "patch") == "12 patches");
}
