// `weft view --serve`: the page of the running graph for a browser on this machine, and when it changed.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "engine/text/diagnostic.h"

namespace httplib {
class Server;
}

namespace weft::app {

class PageServer {
 public:
  // Listens on 127.0.0.1, on any port where that is 0. Null after W180.
  static std::unique_ptr<PageServer> open(int port, text::Diagnostics& diagnostics);
  ~PageServer();
  // With the token, without which nothing is answered.
  const std::string& address() const { return address_; }
  // Counts changes of what the page would show: the page asks for it each second.
  void setChanges(std::uint64_t changes) { changes_ = changes; }
  // Whether a browser waits for a page; give() answers it. The loop of the window is woken when one begins to.
  bool wanted() const { return wanted_; }
  void give(std::string page);

 private:
  PageServer();
  std::string takePage();  // "" when none came in time

  std::unique_ptr<httplib::Server> server_;
  std::string token_, address_;
  std::atomic<std::uint64_t> changes_ = 0;
  std::atomic<bool> wanted_ = false;
  std::mutex mutex_;
  std::condition_variable given_;
  std::uint64_t pages_ = 0;  // given so far
  bool closing_ = false;
  std::string page_;
  std::jthread thread_;
};

}  // namespace weft::app
