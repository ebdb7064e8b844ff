#include "engine/runtime/inspection/trace_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "engine/base/files/temporary_name.h"
#include "engine/base/json/edit.h"

namespace weft::runtime {

namespace {

constexpr int kCpu = 1, kGpu = 2;  // "threads" of the one process

void reportTo(base::Diagnostics& diagnostics, const std::string& path, int reason) {
  diagnostics
      .error(base::Code::outputNotWritten, {std::make_shared<const std::string>(path), 0, 0},
             fmt::format("cannot write '{}': {}", path, std::strerror(reason)))
      .hint = reason == ENOSPC || reason == EFBIG
                  ? "free some space, or name a file on another disk"
                  : "name a file in an existing folder that can be written to";
}

std::string span(const std::string& name, const char* category, int row, double start, double length,
                 const std::string& args) {
  return fmt::format(
      R"({{"name":{},"cat":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},"dur":{:.3f},"args":{{{}}}}})",
      base::quoteJson(name), category, row, start * 1e3, std::max(0.0, length) * 1e3, args);
}

std::string counter(const char* name, double at, const std::string& values) {
  return fmt::format(R"({{"name":"{}","ph":"C","pid":1,"tid":{},"ts":{:.3f},"args":{{{}}}}})", name, kCpu,
                     at * 1e3, values);
}

std::string rowName(const char* what, int row, const char* name) {
  return fmt::format(R"({{"name":"{}","ph":"M","pid":1,"tid":{},"args":{{"name":"{}"}}}})", what, row, name);
}

}  // namespace

std::unique_ptr<TraceFile> TraceFile::create(const std::string& path, base::Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  std::error_code ec;
  if (fs::is_directory(path, ec)) {
    reportTo(diagnostics, path, EISDIR);
    return nullptr;
  }
  const fs::path canonical = fs::canonical(path, ec);
  const std::string target = ec ? path : canonical.string();
  const fs::file_status before = fs::status(target, ec);
  const bool special = fs::exists(before) && !fs::is_regular_file(before);
  const std::string temporary = special ? target : base::temporaryBeside(target);
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) {
    reportTo(diagnostics, path, errno);
    return nullptr;
  }
  std::unique_ptr<TraceFile> made(new TraceFile(path, target, temporary, file));
  made->put("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[");
  made->event(rowName("process_name", kCpu, "weft"));
  made->event(rowName("thread_name", kCpu, "CPU: render thread"));
  made->event(rowName("thread_name", kGpu, "GPU"));
  return made;
}

TraceFile::~TraceFile() {
  base::Diagnostics ignored;
  close(ignored);
}

void TraceFile::put(const std::string& text) {
  errno = 0;
  if (std::fputs(text.c_str(), file_) < 0 && failure_ == 0) failure_ = errno != 0 ? errno : EIO;
}

void TraceFile::event(const std::string& text) {
  if (!file_) return;
  put(first_ ? "\n" : ",\n");
  put(text);
  first_ = false;
}

void TraceFile::add(const FrameProfile& profile) {
  if (frames_++ == 0) origin_ = profile.start;
  const double start = profile.start - origin_;
  event(span(fmt::format("frame {}", profile.frame), "frame", kCpu, start, profile.end - profile.start,
             fmt::format(R"("frame":{},"passes_run":{},"passes_skipped":{},"barriers":{})", profile.frame,
                         profile.report.passesRun, profile.report.passesSkipped, profile.report.barriers)));
  double gpu = 0;
  for (std::size_t step = 0; step < profile.passes.size() && step < profile.names->size(); ++step) {
    const gl::PassTime& pass = profile.passes[step];
    if (!pass.ran) continue;
    const std::string args = fmt::format(R"("frame":{},"step":{})", profile.frame, step);
    event(span((*profile.names)[step], "pass", kCpu, pass.cpuAt - origin_, pass.cpu, args));
    event(span((*profile.names)[step], "pass", kGpu, pass.gpuAt - origin_, pass.gpu, args));
    gpu += pass.gpu;
  }
  event(counter("frame time (ms)", start,
                fmt::format(R"("cpu":{:.3f},"gpu":{:.3f})", profile.end - profile.start, gpu)));
  event(counter(
      "passes", start,
      fmt::format(R"("run":{},"skipped":{})", profile.report.passesRun, profile.report.passesSkipped)));
  event(counter("storage (bytes)", start, fmt::format(R"("allocated":{})", profile.bytesAllocated)));
}

bool TraceFile::close(base::Diagnostics& diagnostics) {
  if (!file_) return failure_ == 0;
  put("\n]}\n");
  errno = 0;
  if (std::fclose(file_) != 0 && failure_ == 0) failure_ = errno != 0 ? errno : EIO;
  file_ = nullptr;
  if (temporary_ != target_) {
    std::error_code ec;
    if (failure_ == 0) std::filesystem::rename(temporary_, target_, ec);
    if (ec) failure_ = ec.value();
    if (failure_ != 0) std::filesystem::remove(temporary_, ec);
  }
  if (failure_ != 0) reportTo(diagnostics, path_, failure_);
  return failure_ == 0;
}

}  // namespace weft::runtime
