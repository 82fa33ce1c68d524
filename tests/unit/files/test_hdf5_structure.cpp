#include "files/hdf5.hpp"
#include "files/hdf5_handle.hpp"
#include "files/hdf5_structure.hpp"
#include "support/temporary_folder.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <hdf5.h>

using namespace bem;
using Catch::Matchers::Contains;

namespace {

/// What is said of a file with two datasets and an attribute that `change` has changed.
std::string fault_after(const std::function<void(hid_t)>& change) {
  const test::TemporaryFolder folder("structure");
  const std::string path = folder / "a";
  Hdf5File file = Hdf5File::create(path);
  file.write("/group/numbers", std::vector<double>(40, 1.5), {10, 4});
  file.write("/indices", std::vector<std::int32_t>(7, 3), {7});
  file.set_attribute("/group", "name", "ball");
  file.set_attribute("/group", "mass", 2.5);
  file.close();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(id);
  H5Fclose(id);
  return hdf5_structure_fault(path, Hdf5Storage::whole);
}

/// A dataset of numbers that are stored as `prepare` says.
void create(hid_t file, hsize_t rows, const std::function<void(hid_t)>& prepare) {
  const hid_t space = H5Screate_simple(1, &rows, nullptr),
              properties = H5Pcreate(H5P_DATASET_CREATE);
  prepare(properties);
  const hid_t made =
      H5Dcreate2(file, "/new", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  H5Dclose(made);
  H5Pclose(properties);
  H5Sclose(space);
}

void chunked(hid_t properties) {
  const hsize_t chunk = 10;
  H5Pset_chunk(properties, 1, &chunk);
}

}  // namespace

TEST_CASE("a file of this project has a good structure") {
  CHECK(fault_after([](hid_t) {}).empty());
}

TEST_CASE("links must form a tree") {
  CHECK_THAT(fault_after(
                 [](hid_t f) { H5Lcreate_soft("/indices", f, "/soft", H5P_DEFAULT, H5P_DEFAULT); }),
             Contains("/soft is a link to another place"));
  CHECK_THAT(fault_after([](hid_t f) {
               H5Lcreate_external("b", "/indices", f, "/outside", H5P_DEFAULT, H5P_DEFAULT);
             }),
             Contains("/outside is a link to another place"));
  CHECK_THAT(fault_after([](hid_t f) {
               H5Lcreate_hard(f, "/indices", f, "/group/again", H5P_DEFAULT, H5P_DEFAULT);
             }),
             Contains("linked to from several places"));
  CHECK_THAT(fault_after([](hid_t f) {
               H5Lcreate_hard(f, "/", f, "/group/loop", H5P_DEFAULT, H5P_DEFAULT);
             }),
             Contains("linked to from several places"));
}

TEST_CASE("datasets must be stored as this project does") {
  CHECK_THAT(fault_after([](hid_t f) { create(f, 100, chunked); }),
             Contains("/new is stored in an unexpected way"));
  CHECK_THAT(fault_after([](hid_t f) {
               create(f, 100, [](hid_t p) { H5Pset_external(p, "secret", 0, 800); });
             }),
             Contains("/new is stored in other files"));
  CHECK_THAT(
      fault_after([](hid_t f) { create(f, 100, [](hid_t p) { H5Pset_layout(p, H5D_COMPACT); }); }),
      Contains("/new is stored in an unexpected way"));
  CHECK_THAT(fault_after([](hid_t f) { create(f, hsize_t(1) << 40, [](hid_t) {}); }),
             Contains("/new promises more numbers"));
  CHECK_THAT(fault_after([](hid_t f) { create(f, 10, [](hid_t) {}); }),
             Contains("/new promises more numbers"));  // never written
  CHECK_THAT(fault_after([](hid_t f) {
               const Hdf5Handle type(H5Tcopy(H5T_NATIVE_INT), H5Tclose);
               H5Tcommit2(f, "/type", type.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
             }),
             Contains("/type is neither a group nor a dataset"));
}

TEST_CASE("chunks of growing files must be there, but for the last row") {
  const test::TemporaryFolder folder("structure_chunks");
  const auto fault = [&](std::size_t written, std::size_t promised, Hdf5Storage storage) {
    Hdf5File file = Hdf5File::create(folder / "a", {"", ErrorCode::resources, 0, true});
    file.create_dataset("/series", Hdf5Type::float64, {0, 600}, {{1, 600}, true});
    file.extend_rows("/series", written);
    const std::vector<double> row(600 * written, 1.0);
    if (written > 0) file.write_rows("/series", 0, written, row.data());
    file.extend_rows("/series", promised);
    file.close();
    return hdf5_structure_fault(folder / "a", storage);
  };
  CHECK(fault(0, 0, Hdf5Storage::growing).empty());
  CHECK(fault(5, 5, Hdf5Storage::growing).empty());
  CHECK(fault(5, 6, Hdf5Storage::growing).empty());
  CHECK_THAT(fault(5, 8, Hdf5Storage::growing), Contains("/series promises more numbers"));
  CHECK_THAT(fault(5, 5, Hdf5Storage::whole), Contains("/series is stored in an unexpected way"));
}
