// Files of cases for `weft test`.
#include "app/trials/case_file.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  const GivenFile file("app/trials/fuzz.cases.json", input);
  text::Diagnostics said;
  app::readCases(file.path(), {}, said);
  expectAnswer(true, said);  // a file may have none: `weft test` says so
}

}  // namespace weft::fuzz
