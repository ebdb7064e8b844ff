#include "app/view/file_alarm.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace weft::app {

namespace {

// Milliseconds between rings that nobody answers by reading: the first, and at most.
constexpr int kPause = 20, kLongestPause = 1000;

void listen(int descriptor, int stop, const std::function<void()>& ring) {
  for (int pause = kPause;;) {
    pollfd both[] = {{stop, POLLIN, 0}, {descriptor, POLLIN, 0}};
    if (::poll(both, 2, -1) < 0) continue;  // a signal
    if (both[0].revents) return;
    if (both[1].revents & ~POLLIN) descriptor = -1;  // closed: it will never be readable
    if (!(both[1].revents & POLLIN)) continue;
    ring();
    if (::poll(both, 1, pause) > 0) return;
    const bool unread = ::poll(both + 1, 1, 0) > 0;
    pause = unread ? std::min(2 * pause, kLongestPause) : kPause;
  }
}

}  // namespace

FileAlarm::FileAlarm(int descriptor, std::function<void()> ring) {
  stop_ = ::eventfd(0, EFD_CLOEXEC);
  if (stop_ >= 0) thread_ = std::thread(listen, descriptor, stop_, std::move(ring));
}

FileAlarm::~FileAlarm() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  while (::write(stop_, &one, sizeof one) < 0) {
  }
  thread_.join();
  ::close(stop_);
}

}  // namespace weft::app
