// SIGINT and SIGTERM, while something goes on that ends between two steps. A second signal ends the program at once.
#pragma once

namespace weft::app {

class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  int signal() const;  // that came; 0: none
};

}  // namespace weft::app
