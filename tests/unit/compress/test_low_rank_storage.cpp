#include "compress/low_rank_storage.hpp"
#include "support/archives.hpp"

#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;
using Catch::Matchers::Contains;

namespace {

using Numbers = std::vector<std::int32_t>;

/// A family of one matrix of one plain block, of which nothing is stored.
struct Tables {
  std::int32_t size;
  Numbers slabs{0, size, 1};
  Numbers blocks{0, size, 0, size, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  Numbers couplings{0, 0, 0, 0, 0, 0};
  std::size_t synthesis = 0;  ///< bytes
  bool symmetric = false;

  std::pair<int, std::string> refusal() const {
    const test::TemporaryFolder folder("low_rank_tables");
    Hdf5File out = Hdf5File::create(folder / "a");
    out.create_group("/m");
    out.set_attribute("/m", "quantum", 1.0);
    if (symmetric) out.set_attribute("/m", "symmetric", 1);
    out.write("/m/slabs", slabs, {slabs.size() / 3, 3});
    out.write("/m/blocks", blocks, {blocks.size() / 17, 17});
    out.write("/m/couplings", couplings, {couplings.size() / 6, 6});
    for (const char* name : {"/m/input_scales", "/m/output_scales"})
      out.create_dataset(name, Hdf5Type::float32, {0});
    out.create_dataset("/m/analysis", Hdf5Type::uint8, {0});
    out.write("/m/synthesis", std::vector<std::uint8_t>(synthesis, 63), {synthesis});
    out.close();
    const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
    return error_of([&] {
      read_low_rank(file, "/m", static_cast<std::size_t>(size), 1, nullptr, [](std::size_t) {});
    });
  }
};

}  // namespace

TEST_CASE("tables of a family that fit each other are read") {
  CHECK(Tables{12}.refusal().first == 0);
  Tables whole{12};
  whole.couplings = {12, 12, 12, 12, 12, 12};
  whole.synthesis = 4 * 144;
  CHECK(whole.refusal().first == 0);
}

TEST_CASE("extents of layers beyond 16 bits are refused, not cut") {
  Tables tables{70000};
  tables.couplings = {65535, 65536, 65537, 1, 1, 1};
  tables.synthesis = 131072;
  const auto [code, message] = tables.refusal();
  CHECK(code == 4);
  CHECK_THAT(message, Contains("/m/couplings is out of range"));
}

TEST_CASE("blocks must tile their slabs") {
  const auto refused = [](const std::function<void(Tables&)>& change) {
    Tables tables{12};
    tables.slabs[2] = 2;
    tables.couplings.insert(tables.couplings.end(), 6, 0);
    Numbers second = tables.blocks;
    tables.blocks[3] = second[2] = 5;  // columns [0, 5) and [5, 12)
    tables.blocks.insert(tables.blocks.end(), second.begin(), second.end());
    change(tables);
    return tables.refusal();
  };
  CHECK(refused([](Tables&) {}).first == 0);
  for (const auto& [place, value] : std::vector<std::pair<std::size_t, std::int32_t>>{
           {3, 6}, {3, 4}, {1, 11}, {17 + 2, 4}, {17 + 3, 11}, {17, 1}, {4, 2}}) {
    CAPTURE(place, value);
    const auto [code, message] =
        refused([place = place, value = value](Tables& t) { t.blocks[place] = value; });
    CHECK(code == 4);
    CHECK_THAT(message, Contains("/m/blocks"));
  }
}

TEST_CASE("blocks of a symmetric family tile what is on and to the right of its own blocks") {
  const auto refused = [](const std::function<void(Tables&)>& change) {
    Tables tables{12};
    tables.symmetric = true;
    tables.slabs[2] = 3;
    tables.couplings.insert(tables.couplings.end(), 12, 0);
    Numbers second = tables.blocks, third = tables.blocks;
    tables.blocks[1] = tables.blocks[3] = 5;  // [0, 5) with itself
    second[1] = second[2] = 5;                // and with [5, 12)
    third[0] = third[2] = 5;                  // that with itself
    for (const Numbers& block : {second, third})
      tables.blocks.insert(tables.blocks.end(), block.begin(), block.end());
    change(tables);
    return tables.refusal();
  };
  CHECK(refused([](Tables&) {}).first == 0);
  CHECK(refused([](Tables& t) { t.symmetric = false; }).first == 4);
  for (const auto& [place, value] : std::vector<std::pair<std::size_t, std::int32_t>>{
           {1, 4}, {3, 6}, {17 + 2, 4}, {17 + 3, 11}, {17, 1}, {34, 4}, {34 + 2, 0}, {34 + 2, 6}}) {
    CAPTURE(place, value);
    const auto [code, message] =
        refused([place = place, value = value](Tables& t) { t.blocks[place] = value; });
    CHECK(code == 4);
    CHECK_THAT(message, Contains("/m/blocks"));
  }
}

TEST_CASE("single precision entries of compressed matrices are finite") {
  Tables tables{3};
  tables.couplings = {3, 3, 3, 3, 3, 3};
  tables.synthesis = 36;
  CHECK(tables.refusal().first == 0);
  const test::TemporaryFolder folder("low_rank_entries");
  LowRankSlab slab;
  slab.row_end = 3;
  slab.blocks.resize(1);
  slab.blocks[0].row_end = slab.blocks[0].column_end = 3;
  slab.blocks[0].plain = true;
  slab.couplings.resize(1);
  for (auto* extents : {&slab.couplings[0].rows, &slab.couplings[0].columns}) extents->fill(3);
  FloatMatrix entries = FloatMatrix::Constant(3, 3, 1e6F);
  entries(1, 2) = std::numeric_limits<float>::quiet_NaN();
  store_layers(slab.couplings[0], entries, slab.synthesis);
  Hdf5File out = Hdf5File::create(folder / "a");
  std::vector<LowRankSlab> slabs;
  slabs.push_back(std::move(slab));
  write_low_rank(out, "/m", LowRankFamily(3, 1, 1.0, std::move(slabs), MatrixForm::general),
                 [](std::size_t) {});
  out.close();
  const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
  const auto [code, message] =
      error_of([&] { read_low_rank(file, "/m", 3, 1, nullptr, [](std::size_t) {}); });
  CHECK(code == 4);
  CHECK_THAT(message, Contains("/m/synthesis"));
}
