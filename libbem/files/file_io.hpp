#pragma once

#include "files/file_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

// Calls of the operating system on files, made again where a signal interrupts them or only a part
// is done. Each returns 0, or the error number that says why not.

namespace bem {

/// Writes all bytes where the file stands.
int append_fully(int file, const void* data, std::size_t size);
/// Writes all bytes at a position.
int write_fully(int file, const void* data, std::size_t size, std::uint64_t position);
/// Reads up to `size` bytes from a position; `got` are fewer at the end of the file.
int read_fully(int file, void* out, std::size_t size, std::uint64_t position, std::size_t& got);
/// Reads a whole file, which may be a pipe.
int read_all(const std::string& path, std::string& out);
int cut_file(int file, std::uint64_t size);
/// Waits until the file is on the disk.
int sync_file(int file);
int sync_file(const std::string& path);
/// Waits until the names in a folder are on the disk; file systems that cannot are left alone.
int sync_folder(const std::string& path);
/// Some file systems tell of failed writes only here.
int close_file(FileDescriptor& file);

/// The folder of a file: "." for a bare name.
std::string folder_of(const std::string& path);

/// Throws ErrorCode::resources, "PATH: WHAT (cause)", unless `error` is 0.
void check_io(int error, const std::string& path, const char* what = "cannot be written");

}  // namespace bem
