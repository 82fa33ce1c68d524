#pragma once

#include "output/file_record.hpp"
#include "output/frame.hpp"

namespace bem {

/// Writes the frames of a run in one format. One that is made with a number `kept` > 0 goes on with
/// the output of an earlier run of the same bodies: its first `kept` frames stay, what comes after
/// them goes. In the end every byte is as if the run had never stopped. It throws
/// ErrorCode::invalid_input if there are not as many frames.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Writes one frame, the next one by its index. When the call returns the frame is in the hands
  /// of the operating system, unless the writer says that it waits for others: a process that dies
  /// later does not take it along. Throws ErrorCode::resources if it cannot be written,
  /// ErrorCode::internal if it does not fit the bodies.
  virtual void write(const Frame& frame) = 0;

  /// Waits until all frames so far are on the disk: what a checkpoint that counts on them calls
  /// before. Throws ErrorCode::resources.
  virtual void sync() = 0;

  /// What the frames so far have added to the files.
  const FileRecords& records() const { return records_; }
  /// Of the frames that are kept, which a writer that goes on does not read.
  void set_records(FileRecords records) { records_ = std::move(records); }

  /// Completes the output; no call may follow. A writer that goes away without it leaves all its
  /// frames readable. Throws ErrorCode::resources.
  virtual void close() = 0;

 protected:
  FrameWriter() = default;
  FileRecords records_;
};

}  // namespace bem
