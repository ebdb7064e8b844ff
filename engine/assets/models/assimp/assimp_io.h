// What Assimp reads through: files in memory, and nothing that the model's folder does not hold. Internal to the folder.
#pragma once

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cstring>
#include <map>
#include <optional>
#include <string>

#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// A file in memory.
class MemoryStream final : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string bytes) : bytes_(std::move(bytes)) {}
  std::size_t Read(void* out, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    std::memcpy(out, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (offset > bytes_.size() - from) return aiReturn_FAILURE;
    at_ = from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// All that Assimp may open: the model itself, which was read and checked, and material libraries of its folder.
class ModelIo final : public Assimp::IOSystem {
 public:
  ModelIo(std::string name, std::string bytes, ModelFiles& files)
      : name_(std::move(name)), bytes_(std::move(bytes)), files_(files) {}

  bool Exists(const char* path) const override { return path == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (std::strchr(mode, 'w') || std::strchr(mode, 'a')) return nullptr;
    if (path == name_) return new MemoryStream(bytes_);
    std::string wanted = path;
    std::ranges::replace(wanted, '\\', '/');
    while (wanted.starts_with("./")) wanted.erase(0, 2);
    // Each file once; Assimp asks again under a name of its own for a library that is missing.
    if (const auto known = others_.find(wanted); known != others_.end())
      return known->second ? new MemoryStream(*known->second) : nullptr;
    if (missing_) return nullptr;
    auto bytes = files_.readOptional(wanted, files_.place(), base::Code::modelPartLeftOut, false);
    missing_ = !bytes;
    const auto& kept = others_.emplace(wanted, std::move(bytes)).first->second;
    return kept ? new MemoryStream(*kept) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_, bytes_;
  ModelFiles& files_;
  std::map<std::string, std::optional<std::string>> others_;
  bool missing_ = false;
};

class Progress final : public Assimp::ProgressHandler {
 public:
  explicit Progress(const LoadObserver& observer) : observer_(observer) {}
  bool Update(float done) override {
    return !observer_ || observer_(LoadStage::decoding, std::clamp(static_cast<double>(done), 0.0, 1.0) / 2);
  }

 private:
  const LoadObserver& observer_;
};

}  // namespace weft::assets
