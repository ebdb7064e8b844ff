#include "app/view/page_server.h"

#include "app_sentences.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <random>

namespace weft::app {

namespace {

constexpr std::chrono::seconds kPatience{60};  // a frame with everything on may take long

std::string makeToken() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace

PageServer::PageServer() : server_(std::make_unique<httplib::Server>()), token_(makeToken()) {
  server_->set_socket_options([](socket_t) {});  // a port that is taken is not shared
  const auto answer = [this](const char* path, auto&& with) {
    server_->Get(path, [this, with](const httplib::Request& request, httplib::Response& response) {
      response.set_header("Cache-Control", "no-store");
      response.set_header("Referrer-Policy", "no-referrer");
      if (request.get_param_value("token") == token_) return with(response);
      response.status = 403;
      response.set_content("the address needs the token that weft view printed\n", "text/plain");
    });
  };
  answer("/", [this](httplib::Response& response) {
    const std::string page = takePage();
    if (page.empty()) response.status = 503;
    response.set_content(page.empty() ? "no frame was drawn: is the window minimized?\n" : page,
                         "text/html; charset=utf-8");
  });
  answer("/changes", [this](httplib::Response& response) {
    response.set_content(fmt::to_string(changes_.load()), "text/plain");
  });
}

std::unique_ptr<PageServer> PageServer::open(int port, text::Diagnostics& diagnostics) {
  std::unique_ptr<PageServer> made(new PageServer);
  const int bound = port == 0 ? made->server_->bind_to_any_port("127.0.0.1")
                              : (made->server_->bind_to_port("127.0.0.1", port) ? port : -1);
  if (bound < 0) {
    diagnostics.error(say::portTaken, text::placeOfOption("--serve"), port);
    return nullptr;
  }
  made->address_ = fmt::format("http://127.0.0.1:{}/?token={}", bound, made->token_);
  made->thread_ = std::jthread([server = made->server_.get()] { server->listen_after_bind(); });
  while (!made->server_->is_running()) std::this_thread::yield();  // else stop() does nothing
  return made;
}

PageServer::~PageServer() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  given_.notify_all();
  server_->stop();
}

std::string PageServer::takePage() {
  std::unique_lock lock(mutex_);
  const std::uint64_t before = pages_;
  wanted_ = true;
  glfwPostEmptyEvent();
  given_.wait_for(lock, kPatience, [&] { return closing_ || pages_ != before; });
  return pages_ != before ? page_ : "";
}

void PageServer::give(std::string page) {
  const std::lock_guard lock(mutex_);
  wanted_ = false;
  page_ = std::move(page);
  ++pages_;
  given_.notify_all();
}

}  // namespace weft::app
