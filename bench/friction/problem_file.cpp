#include "problem_file.hpp"

#include "files/hdf5.hpp"

#include <map>

namespace bem {
namespace {

void check(bool condition, const std::string& path, const char* what) {
  if (!condition) throw Error(ErrorCode::invalid_input, path + ": " + what);
}

Eigen::VectorXd read_vector(const Hdf5File& file, const std::string& name) {
  const std::vector<double> values = file.read<double>(name);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

FrictionProblem read_friction_problem(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path, ErrorCode::invalid_input);
  const auto data = file.read<double>("/W/data");
  const auto rows = file.read<std::int64_t>("/W/indices");
  const auto starts = file.read<std::int64_t>("/W/indptr");
  FrictionProblem problem;
  problem.q = read_vector(file, "/q");
  problem.mu = read_vector(file, "/mu");
  const int n = problem.contacts();
  check(problem.q.size() == 3 * n, path, "/q needs three values per value of /mu");
  check(starts.size() == static_cast<std::size_t>(3 * n) + 1 && rows.size() == data.size() &&
            starts.front() == 0 && starts.back() == static_cast<std::int64_t>(data.size()),
        path, "/W is not a 3n x 3n matrix in compressed columns");

  std::vector<std::map<int, Mat3>> blocks(n);
  for (int i = 0; i < n; ++i) blocks[i][i] = Mat3::Zero();
  for (int column = 0; column < 3 * n; ++column) {
    check(starts[column] <= starts[column + 1], path, "/W/indptr must not decrease");
    for (std::int64_t k = starts[column]; k < starts[column + 1]; ++k) {
      check(rows[k] >= 0 && rows[k] < 3 * n, path, "/W/indices is out of range");
      const int row = static_cast<int>(rows[k]);
      const auto [entry, fresh] = blocks[row / 3].try_emplace(column / 3, Mat3::Zero());
      entry->second(row % 3, column % 3) += data[k];
    }
  }
  for (const auto& row : blocks) {
    for (const auto& [column, block] : row) {
      problem.columns.push_back(column);
      problem.blocks.push_back(block);
    }
    problem.row_start.push_back(static_cast<int>(problem.columns.size()));
  }
  check_problem(problem);
  return problem;
}

void write_friction_problem(const std::string& path, const FrictionProblem& problem) {
  const auto n = static_cast<std::size_t>(problem.contacts());
  std::vector<std::vector<int>> rows(n);  // contacts with a block in a column
  std::vector<std::vector<const Mat3*>> blocks(n);
  for (int i = 0; i < problem.contacts(); ++i)
    for (int k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      rows[problem.columns[k]].push_back(i);
      blocks[problem.columns[k]].push_back(&problem.blocks[k]);
    }
  std::vector<double> data;
  std::vector<std::int64_t> indices, starts = {0};
  for (std::size_t column = 0; column < n; ++column)
    for (int c = 0; c < 3; ++c) {
      for (std::size_t b = 0; b < rows[column].size(); ++b)
        for (int r = 0; r < 3; ++r) {
          data.push_back((*blocks[column][b])(r, c));
          indices.push_back(3 * rows[column][b] + r);
        }
      starts.push_back(static_cast<std::int64_t>(data.size()));
    }
  Hdf5File file = Hdf5File::create(path);
  file.write("/W/data", data, {data.size()});
  file.write("/W/indices", indices, {indices.size()});
  file.write("/W/indptr", starts, {starts.size()});
  file.write("/q", problem.q.data(), {3 * n});
  file.write("/mu", problem.mu.data(), {n});
  file.close();
}

}  // namespace bem
