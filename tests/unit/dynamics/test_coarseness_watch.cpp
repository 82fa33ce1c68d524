#include "dynamics/coarseness_watch.hpp"
#include "files/state_file.hpp"
#include "mesh/shapes.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

const TriangleMesh ball = icosphere(1, 1);

Eigen::VectorXd values_of(const std::function<Vec3(const Vec3&)>& field) {
  Eigen::VectorXd out(3 * ball.vertices.size());
  for (std::size_t i = 0; i < ball.vertices.size(); ++i)
    out.segment<3>(static_cast<Eigen::Index>(3 * i)) = field(ball.vertices[i]);
  return out;
}

const Eigen::VectorXd stretch = values_of([](const Vec3& x) { return Vec3(x[0], 0, 0); });
const Eigen::VectorXd bend = values_of([](const Vec3& x) { return Vec3(0, 0, x[0] * x[0]); });
const Eigen::VectorXd turn = values_of([](const Vec3& x) { return Vec3(-x[1], x[0], 0); });

}  // namespace

TEST_CASE("the largest bubble part is related to the largest deformation", "[dynamics]") {
  const Coarseness mesh(ball);
  CoarsenessWatch watch(bend.size());
  CHECK(watch.reconstructed_part() == 0);
  CHECK_FALSE(watch.is_deformed());
  watch.record(mesh, 1e-3 * bend, 1);
  const FieldNorms of_bend = mesh.norms(bend);
  CHECK(watch.reconstructed_part() == Approx(of_bend.bubbles / of_bend.deformation));
  watch.record(mesh, 0.1 * stretch, 2);
  watch.record(mesh, 1e-5 * bend, 3);  // nothing but bubbles in it, but small
  const FieldNorms of_stretch = mesh.norms(0.1 * stretch);
  CHECK(watch.reconstructed_part() == Approx(1e-3 * of_bend.bubbles / of_stretch.deformation));
  CHECK(watch.time() == 1);
  CHECK(watch.displacement() == 1e-3 * bend);
}

TEST_CASE("a body that only moves is not deformed", "[dynamics]") {
  const Coarseness mesh(ball);
  CoarsenessWatch watch(bend.size());
  watch.record(mesh, Eigen::VectorXd::Zero(bend.size()), 0.1);
  watch.record(mesh, 0.3 * turn, 0.2);
  watch.record(mesh, 1e-13 * bend, 0.3);
  CHECK_FALSE(watch.is_deformed());
  CHECK(watch.reconstructed_part() == 0);
}

TEST_CASE("a watch of coarseness that is restored goes on in the same way", "[dynamics]") {
  const test::TemporaryFolder folder("coarseness_watch");
  const Coarseness mesh(ball);
  CoarsenessWatch whole(bend.size()), first(bend.size()), second(bend.size());
  for (CoarsenessWatch* w : {&whole, &first}) w->record(mesh, 0.01 * bend + 0.1 * turn, 1);
  {
    StateWriter writer(folder / "state");
    writer(first);
    writer.commit();
  }
  StateReader reader(folder / "state");
  reader(second);
  reader.finish();
  for (CoarsenessWatch* w : {&whole, &second}) w->record(mesh, 0.02 * stretch, 2);
  CHECK(second.is_deformed());
  CHECK(second.time() == 1);
  CHECK(second.reconstructed_part() == whole.reconstructed_part());
  CHECK(second.displacement() == whole.displacement());

  CoarsenessWatch other(bend.size() + 3);  // of another mesh
  StateReader again(folder / "state");
  CHECK_THROWS(again(other));
}
