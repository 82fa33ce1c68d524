#include "writers.hpp"

#include "base/error.hpp"

namespace bem {

void check_output_records(const OutputFormats& formats, const TrajectoryContents& contents,
                          const std::string& directory, std::size_t frames,
                          const OutputRecords& records) {
  require(records.size() == formats.size(), "a checkpoint knows the files of every format");
  const auto refuse = [](const std::string& text) {
    throw Error(ErrorCode::invalid_input,
                text +
                    "; the run cannot go on from its checkpoint without this output as it was: "
                    "restore it, or start anew with --force");
  };
  for (std::size_t i = 0; i < formats.size(); ++i) {
    FileRecords found;
    try {
      found = formats[i]->read_records(directory, contents, frames);
    } catch (const Error& e) {
      if (e.code() != ErrorCode::invalid_input) throw;
      refuse(e.what());
    }
    const std::string text = difference(records[i], found);
    if (!text.empty()) refuse(directory + "/" + text);
  }
}

Writers::Writers(const OutputFormats& formats, const TrajectoryContents& contents,
                 const std::string& directory, std::size_t kept, const OutputRecords& records) {
  for (const OutputFormat* format : formats) {
    writers_.push_back(format->make_writer(directory, contents, kept));
    if (kept > 0) writers_.back()->set_records(records[writers_.size() - 1]);
  }
}

void Writers::write(const Frame& frame) {
  for (const auto& writer : writers_) writer->write(frame);
}

OutputRecords Writers::sync() {
  OutputRecords records;
  for (const auto& writer : writers_) {
    writer->sync();
    records.push_back(writer->records());
  }
  return records;
}

void Writers::close() {
  for (const auto& writer : writers_) writer->close();
}

}  // namespace bem
