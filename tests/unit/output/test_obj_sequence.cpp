#include "mesh/mesh_io.hpp"
#include "output/frame_files.hpp"
#include "output/obj_sequence.hpp"
#include "output_test.hpp"

using namespace bem;
using Catch::Matchers::StartsWith;
using test::error_message;
using test::names_in;

TEST_CASE("OBJ frames hold the vertices and faces of the mesh, bit by bit") {
  const test::TemporaryFolder folder("obj_sequence");
  const auto bodies = test::sample_bodies();
  ObjSequence writer(folder.path(), bodies);
  writer.write(test::sample_frame(0));
  writer.write(test::sample_frame(1));
  writer.close();
  CHECK(names_in(folder / "obj") ==
        std::vector<std::string>{"large one_000000.obj", "large one_000001.obj", "small_000000.obj",
                                 "small_000001.obj"});
  for (const std::size_t index : {0, 1})
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const TriangleMesh mesh =
          read_mesh(folder / "obj/" + frame_file_name(bodies[b].name, index, ".obj"));
      CHECK(mesh.vertices == test::sample_frame(index).bodies[b].positions);
      CHECK(mesh.triangles == bodies[b].triangles);
    }
}

TEST_CASE("an OBJ frame replaces an older one") {
  const test::TemporaryFolder folder("obj_again");
  ObjSequence(folder.path(), test::sample_contents()).write(test::sample_frame(0));
  const std::string before = test::read_file(folder / "obj/small_000000.obj");
  Frame other = test::sample_frame(0);
  other.bodies[0].positions[0] = Vec3(7, 8, 9);
  ObjSequence(folder.path(), test::sample_contents()).write(other);
  const std::string after = test::read_file(folder / "obj/small_000000.obj");
  CHECK_THAT(after, StartsWith("v 7 8 9\n"));
  CHECK(after != before);
}

TEST_CASE("OBJ frames that cannot be written are a resource error") {
  const test::TemporaryFolder folder("obj_error");
  const std::string missing = folder / "missing";
  CHECK_THAT(error_message(ErrorCode::resources, [&] { ObjSequence(missing, {}); }),
             StartsWith(missing + "/obj: "));
  ObjSequence writer(folder.path(), test::sample_contents());
  std::filesystem::create_directories(folder / "obj/small_000000.obj/in_the_way");
  CHECK_THAT(error_message(ErrorCode::resources, [&] { writer.write(test::sample_frame(0)); }),
             StartsWith(folder / "obj/small_000000.obj: "));
}

TEST_CASE("a sequence of OBJ frames that goes on ends in the same bytes") {
  test::check_going_on<ObjSequence>(3, 3);
  test::check_going_on<ObjSequence>(5, 2);
  test::check_going_on<ObjSequence>(7, 7);
}

TEST_CASE("what a checkpoint counts on is compared with the files of a ObjSequence") {
  test::check_damage<ObjSequence>();
}
