#include "tests/graph/compile/random_graph.h"

#include <random>
#include <vector>

#include "engine/graph/versions/versions.h"

namespace weft::graph {

namespace {

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed), b_(emptyGraph()) {}

  FlatBuilder make() {
    streaming_ = chance(60);
    const std::size_t passes = 2 + pick(20), resources = streaming_ ? 8 + pick(24) : 3 + pick(12);
    histories_ = chance(streaming_ ? 15 : 40);
    cadences_ = chance(streaming_ ? 15 : 40);
    slices_ = cadences_ && chance(50);
    clears_ = chance(50);
    const bool compute = chance(85);
    for (std::size_t i = 0; i < resources; ++i) addResource(i);
    for (std::size_t p = 0; p < passes; ++p) addPass(p, compute && chance(55));
    finish();
    return std::move(b_);
  }

 private:
  std::size_t pick(std::size_t n) { return random_() % n; }
  bool chance(unsigned percent) { return random_() % 100 < percent; }
  bool streaming() { return streaming_ && chance(85); }

  // In a streaming graph reads look a little way back and writes go ahead, so that lifetimes are short.
  std::uint32_t toRead() {
    const std::size_t count = b_.graph.resources.size();
    return static_cast<std::uint32_t>(
        streaming() && front_ > 0 ? front_ - 1 - pick(std::min<std::size_t>(front_, 3)) : pick(count));
  }
  std::uint32_t toWrite() {
    const std::size_t count = b_.graph.resources.size();
    return static_cast<std::uint32_t>(streaming() && front_ < count ? front_++ : pick(count));
  }

  void addResource(std::size_t i) {
    const std::string name = "r" + std::to_string(i);
    std::uint32_t r = 0;
    if (chance(30)) {
      constexpr std::uint64_t sizes[] = {16, 256, 300, 700, 1024};
      r = b_.buffer(name, sizes[pick(5)]);
    } else {
      constexpr Format formats[] = {Format::rgba8,           Format::r32f,    Format::rgba8,
                                    Format::rgba16f,         Format::rgb9_e5, Format::depth32f,
                                    Format::depth24_stencil8};
      const Format format = formats[pick(streaming_ ? 4 : 7)];
      const auto mips = static_cast<std::uint16_t>(chance(streaming_ ? 12 : 30) ? 1 + pick(3) : 1);
      const auto layers = static_cast<std::uint16_t>(chance(streaming_ ? 8 : 25) ? 1 + pick(3) : 1);
      r = b_.texture(name, format, chance(streaming_ ? 95 : 70) ? 16 : 8, mips, layers);
    }
    FlatResource& resource = b_.resource(r);
    if (chance(streaming_ ? 3 : 8)) {
      resource.kind = isBuffer(resource) ? ResourceKind::imported_buffer : ResourceKind::imported_texture;
    } else if (histories_ && chance(35)) {
      resource.history = static_cast<std::uint8_t>(1 + pick(2));
    } else if (clears_ && chance(40)) {
      resource.hasClear = true;
    }
    versions_.emplace_back(subresourceCount(resource), isImported(resource) || resource.hasClear ? 1 : 0);
    locked_.emplace_back(subresourceCount(resource), 0);
  }

  // A use of all of r or of a part.
  FlatUse someRange(std::uint32_t r) {
    const FlatResource& resource = b_.resource(r);
    FlatUse use = b_.whole(r, Kind::sampled, Access::read);
    if (isBuffer(resource) || chance(streaming_ ? 80 : 50)) return use;
    use.mip = static_cast<std::uint16_t>(pick(resource.mips));
    use.mips = static_cast<std::uint16_t>(1 + pick(resource.mips - use.mip));
    use.layer = static_cast<std::uint16_t>(pick(resource.layers));
    use.layers = static_cast<std::uint16_t>(1 + pick(resource.layers - use.layer));
    if (planesOf(resource) == 2) use.planes = static_cast<std::uint8_t>(1 + pick(3));
    return use;
  }

  bool everyCell(const FlatUse& use, auto&& test) {
    bool all = true;
    forEachSubresource(use, b_.resource(use.resource), [&](std::uint32_t s) { all = all && test(s); });
    return all;
  }
  bool hasVersions(const FlatUse& use) {
    return everyCell(use, [&](std::uint32_t s) { return versions_[use.resource][s] != 0; });
  }
  bool isFree(const FlatUse& use, std::uint8_t of) {
    return everyCell(use, [&](std::uint32_t s) { return (locked_[use.resource][s] & of) == 0; });
  }
  void lock(const FlatUse& use, std::uint8_t as) {
    forEachSubresource(use, b_.resource(use.resource), [&](std::uint32_t s) {
      locked_[use.resource][s] = static_cast<char>(locked_[use.resource][s] | as);
    });
  }

  Kind readKind(const FlatResource& r, bool compute) {
    if (isBuffer(r)) {
      constexpr Kind kinds[] = {Kind::storage, Kind::storage,  Kind::uniform,
                                Kind::copy,    Kind::indirect, Kind::sampled};
      return kinds[pick(6)];
    }
    if (isDepth(r.format) && chance(40)) return Kind::depth;
    if (infoOf(r.format).imageStorable && compute && chance(40)) return Kind::image;
    return chance(12) ? Kind::copy : Kind::sampled;
  }

  // Sampled when nothing else fits: then the use is given up.
  Kind writeKind(const FlatResource& r, bool compute) {
    if (isBuffer(r)) return chance(85) ? Kind::storage : Kind::copy;
    if (chance(8)) return Kind::copy;
    if (isDepth(r.format)) return compute ? Kind::sampled : Kind::depth;
    if (compute) return infoOf(r.format).imageStorable ? Kind::image : Kind::sampled;
    return infoOf(r.format).colorRenderable ? Kind::color : Kind::sampled;
  }

  void addPass(std::size_t p, bool compute) {
    constexpr Cadence cadences[] = {Cadence::once, Cadence::on_change};
    b_.pass("p" + std::to_string(p), cadences_ && chance(35) ? cadences[pick(2)] : Cadence::always);
    FlatPass& pass = b_.graph.passes.back();
    if (pass.cadence != Cadence::always && slices_ && chance(20))
      pass.slices = static_cast<std::uint32_t>(2 + pick(3));
    if (chance(8)) b_.sideEffect();
    // As a type that makes mip levels by whatever the driver likes.
    if (chance(6)) pass.touches = kBarrierFramebuffer | kBarrierTexture | kBarrierTextureUpdate;
    for (auto& cells : locked_) std::fill(cells.begin(), cells.end(), 0);
    for (std::size_t i = 2 + pick(6); i > 0; --i) addRead(compute);
    for (std::size_t i = 1 + pick(4); i > 0; --i) addWrite(compute);
    for (std::size_t r = 0; r < locked_.size(); ++r)
      for (std::size_t s = 0; s < locked_[r].size(); ++s)
        if ((locked_[r][s] & 2) != 0) versions_[r][s] = 2;
  }

  void addRead(bool compute) {
    const auto r = toRead();
    const FlatResource& resource = b_.resource(r);
    FlatUse use = someRange(r);
    use.kind = readKind(resource, compute);
    if (resource.history > 0 && chance(60)) {
      use.history = static_cast<std::uint8_t>(1 + pick(resource.history));
      if (use.kind == Kind::depth) use.kind = Kind::sampled;
    } else if (!hasVersions(use)) {
      return;
    } else {
      lock(use, 1);
    }
    b_.use(use);
  }

  void addWrite(bool compute) {
    const auto r = toWrite();
    const FlatResource& resource = b_.resource(r);
    if (isImported(resource)) return;
    FlatUse use = someRange(r);
    use.kind = writeKind(resource, compute);
    if (use.kind == Kind::sampled || !isFree(use, 3)) return;
    use.access = chance(40) && hasVersions(use) ? Access::modify : Access::write;
    use.feedback = use.access == Access::modify && use.kind == Kind::color && chance(20);
    use.keep = chance(10);
    lock(use, 2);
    b_.use(use);
  }

  void finish() {
    if (chance(85)) {  // something that looks at the outcome, so that most of the graph lives
      b_.pass("sink").sideEffect();
      for (auto& cells : locked_) std::fill(cells.begin(), cells.end(), 0);
      for (std::size_t i = 3 + pick(9); i > 0; --i) addRead(true);
    }
    std::vector<std::uint32_t> shown;
    for (std::uint32_t r = 0; r < b_.graph.resources.size(); ++r) {
      const FlatUse whole = b_.whole(r, Kind::copy, Access::read);
      if (!hasVersions(whole)) continue;
      const bool written = !everyCell(whole, [&](std::uint32_t s) { return versions_[r][s] != 2; });
      if (written && !isBuffer(b_.resource(r)) && !isDepth(b_.resource(r).format)) shown.push_back(r);
      if (chance(10)) b_.output(r);
    }
    if (!shown.empty()) b_.present(shown[pick(shown.size())]);
    while (slices_ && joinAlwaysWriters()) {
    }
  }

  // What a time-sliced group writes must not be written by passes of other groups (W077): a pass that does joins the
  // group. False when no pass is left that does.
  bool joinAlwaysWriters() {
    const Groups groups = formGroups(b_.graph, {std::vector<std::uint8_t>(b_.graph.passes.size(), 1),
                                                std::vector<std::uint8_t>(b_.graph.uses.size(), 1)});
    bool any = false;
    for (FlatPass& pass : b_.graph.passes)
      for (std::uint32_t u = pass.firstUse;
           pass.cadence == Cadence::always && u < pass.firstUse + pass.useCount; ++u)
        if (b_.graph.uses[u].access != Access::read &&
            groups.slicedWriterOf(b_.graph.uses[u].resource) != kNone) {
          pass.cadence = Cadence::on_change;
          any = true;
        }
    return any;
  }

  std::mt19937_64 random_;
  FlatBuilder b_;
  std::size_t front_ = 0;  // resources below it have had their turn to be written
  bool streaming_ = false, histories_ = false, cadences_ = false, slices_ = false, clears_ = false;
  std::vector<std::vector<char>> versions_, locked_;  // per resource and sub-resource
  // versions: 0 none, 1 version zero, 2 written; locked by the pass being made: 1 read, 2 written
};

}  // namespace

FlatBuilder randomGraph(std::uint64_t seed) {
  return Generator(seed).make();
}

}  // namespace weft::graph
