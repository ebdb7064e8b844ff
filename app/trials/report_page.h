// One self-contained HTML page: the cases of `weft test`, of those that failed each picture beside its golden and the
// difference.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/trials/case_run.h"

namespace weft::app {

std::string reportPage(const std::vector<std::pair<TestCase, CaseResult>>& results);

// Parts of such a page: up to <body>; a picture; `text` as it stands in HTML.
std::string pageHead(std::string_view title);
std::string imageTag(const assets::Image8& image, std::string_view alt);
std::string escapeHtml(std::string_view text);

}  // namespace weft::app
