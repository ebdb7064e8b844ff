// Names in folders, to find the nearest to a misspelt one in. A folder is listed once while it stays as it
// is, however many names are missing in it. Does not: say what is complete; a hint may do without the rest.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace weft::base {

// The names in `folder`, sorted, at most 5,000; remembered while the folder's time of change stays. Empty for
// what cannot be listed. Whether the folder may be looked at is the caller's question. Safe from any thread.
std::shared_ptr<const std::vector<std::string>> namesIn(const std::string& folder);

}  // namespace weft::base
