/// Gives a target all files of a folder, and changed ones: the same in every run, with any
/// compiler. Prints how many were accepted and refused; a crash names the input.

#include "mutation.hpp"
#include "target.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

volatile long current = -1;  ///< number of the changed input, for the message of a crash

void name_input(int) {
  std::fprintf(stderr, "crashed with changed input %ld\n", current);
  std::_Exit(99);
}

std::vector<std::string> read_folder(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry);
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s FOLDER CHANGES [KEEP_NUMBER FILE]\n", argv[0]);
    return 2;
  }
  std::signal(SIGABRT, name_input);
  std::signal(SIGSEGV, name_input);
  std::signal(SIGFPE, name_input);
  const std::vector<std::string> inputs = read_folder(argv[1]);
  for (const std::string& input : inputs)
    if (!bem_fuzz::run(input)) {
      std::fprintf(stderr, "a seed was refused\n");
      return 1;
    }
  long refused = 0;
  const long changes = std::atol(argv[2]);
  for (current = 0; current < changes; current = current + 1) {
    std::mt19937_64 random(static_cast<std::uint64_t>(current) + 1);
    const std::string& seed = inputs[static_cast<std::size_t>(current) % inputs.size()];
    const std::string input = bem_fuzz::repaired(bem_fuzz::mutated(seed, random));
    if (argc == 5 && std::atol(argv[3]) == current)
      std::ofstream(argv[4], std::ios::binary) << input;
    refused += !bem_fuzz::run(input);
  }
  std::printf("%zu seeds accepted; of %ld changed inputs %ld accepted, %ld refused\n",
              inputs.size(), changes, changes - refused, refused);
  return inputs.empty() ? 1 : 0;
}
