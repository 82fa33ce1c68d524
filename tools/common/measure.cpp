#include "common/measure.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace bem {
namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_clock() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

std::size_t peak_memory() {
  // getrusage() would give what the process that started this one has had, if that is more
  constexpr std::string_view kKey = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.compare(0, kKey.size(), kKey) == 0)
      return std::stoull(line.substr(kKey.size())) * 1024;
  return 0;
}

std::size_t physical_memory() {
  auto memory = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  for (const char* path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(path);
    std::size_t limit = 0;  // "max" is no number
    if (file >> limit && limit > 0) memory = std::min(memory, limit);
  }
  return memory;
}

void PhaseTimer::begin(const std::string& name) {
  if (running_ && phases_[current_].name == name) return;
  end();
  const auto same = [&name](const Phase& p) { return p.name == name; };
  const auto found = std::find_if(phases_.begin(), phases_.end(), same);
  current_ = static_cast<std::size_t>(found - phases_.begin());
  if (found == phases_.end()) phases_.push_back({name});
  running_ = true;
  wall_start_ = wall_clock();
  cpu_start_ = cpu_clock();
}

void PhaseTimer::end() {
  if (!running_) return;
  Phase& phase = phases_[current_];
  phase.wall_seconds += wall_clock() - wall_start_;
  phase.cpu_seconds += cpu_clock() - cpu_start_;
  phase.peak_memory = bem::peak_memory();
  running_ = false;
}

void PhaseTimer::visit_state(StateArchive& state) {
  end();
  std::vector<Phase> phases = phases_;
  state.resizable(phases);
  if (!state.restores()) return;
  for (Phase& own : phases_) {
    const auto same = [&own](const Phase& p) { return p.name == own.name; };
    const auto earlier = std::find_if(phases.begin(), phases.end(), same);
    if (earlier == phases.end()) {
      phases.push_back(own);
      continue;
    }
    earlier->wall_seconds += own.wall_seconds;
    earlier->cpu_seconds += own.cpu_seconds;
    earlier->peak_memory = std::max(earlier->peak_memory, own.peak_memory);
  }
  phases_ = std::move(phases);
}

double PhaseTimer::total_wall_seconds() const {
  double total = 0;
  for (const Phase& p : phases_) total += p.wall_seconds;
  return total;
}

}  // namespace bem
