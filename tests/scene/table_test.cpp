#include "engine/scene/table.h"

#include <doctest/doctest.h>

#include <string>

using weft::scene::Table;

TEST_CASE("ids survive growth and removal of others, and die with their row") {
  Table<std::string> table;
  std::vector<Table<std::string>::Id> ids;
  for (int i = 0; i < 100; ++i) ids.push_back(table.add(std::to_string(i)));
  CHECK(*table.find(ids[42]) == "42");
  CHECK(table.remove(ids[10]));
  CHECK_FALSE(table.remove(ids[10]));
  CHECK(table.find(ids[10]) == nullptr);
  CHECK(*table.find(ids[99]) == "99");
  CHECK(table.size() == 99);
  CHECK(table.rows()[10] == "11");
  CHECK(table.idOf(10) == ids[11]);
  const auto fresh = table.add("new");
  CHECK(fresh.index == ids[10].index);
  CHECK(table.find(ids[10]) == nullptr);
  CHECK(*table.find(fresh) == "new");
  CHECK(table.rows()[99] == "new");
}

TEST_CASE("ids of nothing are found nowhere; every change counts") {
  Table<int> table;
  CHECK(table.find({}) == nullptr);
  const std::uint64_t before = table.revision();
  const auto id = table.add(1);
  table.edit(id) = 2;
  CHECK(*table.find(id) == 2);
  CHECK(table.revision() == before + 2);
  CHECK(table.find({7, 0}) == nullptr);
}
