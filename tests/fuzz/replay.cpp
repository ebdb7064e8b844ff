// Stands in for libFuzzer where the compiler has none: replay MUTATIONS FILE... gives a target each file, and so many inputs that
// are made of them, the same in every run.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

// `text` with a few changes: bytes, pieces that are gone, doubled or of `other`, and numbers.
std::string changed(std::string text, const std::string& other, std::mt19937& random) {
  static const std::string kNumbers[] = {"0", "-1", "1e300", "65536", "4294967295", "\xff\xff\xff\xff"};
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % text.size(), count = 1 + random() % 16;
    const auto choice = random() % 6;
    if (choice == 0) text.erase(at, count);
    if (choice == 1) text[at] = static_cast<char>(random());
    if (choice == 2) text[at] = static_cast<char>(text[at] ^ 1 << random() % 8);
    if (choice == 3) text.insert(at, text.substr(random() % text.size(), count));
    if (choice == 4 && !other.empty()) text.insert(at, other.substr(random() % other.size(), count * 8));
    if (choice == 5) text.replace(at, count % 4, kNumbers[random() % std::size(kNumbers)]);
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> seeds;
  for (int i = 2; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (!in) return std::fprintf(stderr, "cannot read %s\n", argv[i]), 2;
    run(seeds.back());
  }
  if (seeds.empty()) return std::fprintf(stderr, "no files\n"), 2;
  std::mt19937 random(1);
  const int mutations = std::atoi(argv[1]);
  const char* kept = std::getenv("WEFT_FUZZ_INPUT");  // where each input is written before it is run
  for (int i = 0; i < mutations; ++i) {
    const std::string input = changed(seeds[random() % seeds.size()], seeds[random() % seeds.size()], random);
    if (kept) std::ofstream(kept, std::ios::binary) << input;
    run(input);
  }
  std::printf("\n%zu\n", seeds.size() + static_cast<std::size_t>(mutations));
}
