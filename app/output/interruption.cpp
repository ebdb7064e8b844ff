#include "app/output/interruption.h"

#include <unistd.h>

#include <csignal>
#include <iterator>
#include <string_view>

namespace weft::app {

namespace {

volatile std::sig_atomic_t cameSignal = 0;

constexpr int kSignals[] = {SIGINT, SIGTERM};
struct sigaction actionsBefore[std::size(kSignals)];

void restoreActions() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &actionsBefore[i], nullptr);
}

void note(int signal) {
  constexpr std::string_view kText = "\nweft ends after this frame; a second signal ends it at once\n";
  cameSignal = signal;
  restoreActions();
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, kText.data(), kText.size());
}

}  // namespace

Interruption::Interruption() {
  cameSignal = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    ::sigaction(kSignals[i], nullptr, &actionsBefore[i]);
    if (actionsBefore[i].sa_handler != SIG_IGN)
      ::sigaction(kSignals[i], &action, nullptr);  // as nohup leaves it
  }
}

Interruption::~Interruption() {
  restoreActions();
}

int Interruption::signal() const {
  return cameSignal;
}

}  // namespace weft::app
