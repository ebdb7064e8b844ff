// Binary FBX records for tests: Assimp 5.2's exporter leaves out the empty record that ends a list, which its importer then
// misses. Reads such a file and writes it as other programs do.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace weft::test {

struct FbxRecord {
  std::string name, properties;
  std::uint64_t propertyCount = 0;
  std::vector<FbxRecord> children;
  bool list = false;  // has one, if an empty one
};

// Version 7500 and later: words of 8 bytes.
inline std::vector<FbxRecord> readFbxRecords(const std::string& bytes, std::size_t at, std::size_t end) {
  std::vector<FbxRecord> records;
  while (at + 25 <= end) {
    std::uint64_t words[3];
    std::memcpy(words, bytes.data() + at, 24);
    if (words[0] == 0) break;
    const auto nameBytes = static_cast<unsigned char>(bytes[at + 24]);
    FbxRecord record{
        bytes.substr(at + 25, nameBytes), bytes.substr(at + 25 + nameBytes, words[2]), words[1], {}, false};
    record.children = readFbxRecords(bytes, at + 25 + nameBytes + words[2], words[0]);
    record.list = words[0] > at + 25 + nameBytes + words[2] || record.name == "AnimationLayer";
    records.push_back(std::move(record));
    at = words[0];
  }
  return records;
}

inline void writeFbxRecords(const std::vector<FbxRecord>& records, std::string& out) {
  for (const FbxRecord& record : records) {
    const std::size_t at = out.size();
    const std::uint64_t words[3] = {0, record.propertyCount, record.properties.size()};
    out.append(reinterpret_cast<const char*>(words), 24);
    out.push_back(static_cast<char>(record.name.size()));
    out += record.name + record.properties;
    if (record.list) writeFbxRecords(record.children, out);
    const std::uint64_t end = out.size();
    std::memcpy(out.data() + at, &end, 8);
  }
  out.append(25, 0);
}

inline std::string repairFbx(const std::string& bytes) {
  std::string out = bytes.substr(0, 27);
  writeFbxRecords(readFbxRecords(bytes, 27, bytes.size()), out);
  return out;
}

}  // namespace weft::test
