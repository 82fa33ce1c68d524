// Makes a matrix archive of a rubber ball, as bemprecomp does, and reads it back.
#include <iostream>

#include <archive/archive_reader.hpp>
#include <archive/archive_writer.hpp>
#include <mesh/shapes.hpp>
#include <model/precompute.hpp>
#include <simulation/simulation.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string path = argv[1];
  bem::PrecomputeOptions options;
  options.discretisation.material = {"rubber", 1000, 1e5, 0.3, {}};
  options.discretisation.scheme = bem::Scheme::parse("bdf1");
  options.discretisation.dt = 0.01;
  options.discretisation.history_length = 4;

  const bem::Surface ball = bem::make_surface(bem::icosphere(2, 0.1), "ball");
  const bem::BodyModel model = bem::precompute(bem::make_geometry(ball, 1000), options);
  bem::write_archive(path, model, {"consumer", "ball", "rubber", 1, ""}, true);

  const bem::Archive archive(path);
  std::cout << path << ": " << archive.geometry().nodes.vertices.size() << " nodes, growth factor "
            << archive.report().growth << "\n";
  return 0;
}
