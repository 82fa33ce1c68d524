/* Preloaded into a program: makes one call of the system fail, on files below a folder.
 *
 *   FAULT_FOLDER  absolute path
 *   FAULT_COUNT   file that gets lines "CALL NUMBER" when the program ends: how often each was called
 *   FAULT         CALL:K:KIND: the K-th one fails (K+: all from there on). KIND is an error number;
 *                 "short" (writes half and says so) or "torn" (writes half and fails with EIO)
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

enum { WRITE, PWRITE, FSYNC, FTRUNCATE, RENAME, RENAMEAT2, LINK, CLOSE, FALLOCATE, OPEN, CALLS };
static const char* const names[CALLS] = {"write", "pwrite", "fsync", "ftruncate", "rename",
                                         "renameat2", "link", "close", "fallocate", "open"};
static long counts[CALLS];
static const char* folder;
static int failing = -1, error_number;
static long first;
static int sticky, is_short, is_torn;

__attribute__((constructor)) static void start(void) {
  folder = getenv("FAULT_FOLDER");
  const char* fault = getenv("FAULT");
  if (!fault) return;
  const char* colon = strchr(fault, ':');
  for (int i = 0; colon && i < CALLS; ++i)
    if (strlen(names[i]) == (size_t)(colon - fault) && !strncmp(names[i], fault, colon - fault))
      failing = i;
  if (failing < 0) abort();
  char* rest = NULL;
  first = strtol(colon + 1, &rest, 10);
  sticky = *rest == '+';
  rest += sticky + 1;
  is_short = !strcmp(rest, "short");
  is_torn = !strcmp(rest, "torn");
  error_number = is_torn ? EIO : atoi(rest);
}

__attribute__((destructor)) static void end(void) {
  const char* path = getenv("FAULT_COUNT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  for (int i = 0; i < CALLS; ++i) fprintf(file, "%s %ld\n", names[i], counts[i]);
  fclose(file);
}

static int is_below(const char* path) {
  const size_t length = folder ? strlen(folder) : 0;
  return length > 0 && !strncmp(path, folder, length) && (path[length] == '/' || !path[length]);
}

static int is_file_below(int file) {
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n <= 0) return 0;
  path[n] = '\0';
  return is_below(path);
}

/* Counts a call; is it to fail? */
static int fails(int call) {
  const long k = ++counts[call];
  if (call != failing || k < first || (!sticky && k > first)) return 0;
  errno = error_number;
  return 1;
}

#define REAL(type, name, ...)                                   \
  static type (*real)(__VA_ARGS__);                             \
  if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

ssize_t write(int file, const void* data, size_t size) {
  REAL(ssize_t, "write", int, const void*, size_t);
  if (!is_file_below(file) || !fails(WRITE)) return real(file, data, size);
  if (is_short && size > 1) return real(file, data, size / 2);
  if (is_short) return real(file, data, size);
  if (is_torn && real(file, data, size / 2) >= 0) errno = EIO;
  return -1;
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  REAL(ssize_t, "writev", int, const struct iovec*, int);
  if (!is_file_below(file) || !fails(WRITE)) return real(file, parts, count);
  return is_short ? write(file, parts[0].iov_base, parts[0].iov_len) : -1;
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  REAL(ssize_t, "pwrite", int, const void*, size_t, off_t);
  if (!is_file_below(file) || !fails(PWRITE)) return real(file, data, size, at);
  if (is_short && size > 1) return real(file, data, size / 2, at);
  if (is_short) return real(file, data, size, at);
  if (is_torn && real(file, data, size / 2, at) >= 0) errno = EIO;
  return -1;
}
ssize_t pwrite64(int, const void*, size_t, off_t) __attribute__((alias("pwrite")));

int fsync(int file) {
  REAL(int, "fsync", int);
  return is_file_below(file) && fails(FSYNC) ? -1 : real(file);
}

int ftruncate(int file, off_t size) {
  REAL(int, "ftruncate", int, off_t);
  return is_file_below(file) && fails(FTRUNCATE) ? -1 : real(file, size);
}
int ftruncate64(int, off_t) __attribute__((alias("ftruncate")));

int rename(const char* from, const char* to) {
  REAL(int, "rename", const char*, const char*);
  return is_below(to) && fails(RENAME) ? -1 : real(from, to);
}

int renameat2(int a, const char* from, int b, const char* to, unsigned flags) {
  REAL(int, "renameat2", int, const char*, int, const char*, unsigned);
  return is_below(to) && fails(RENAMEAT2) ? -1 : real(a, from, b, to, flags);
}

int link(const char* from, const char* to) {
  REAL(int, "link", const char*, const char*);
  return is_below(to) && fails(LINK) ? -1 : real(from, to);
}

/* Whatever it says the file is closed. */
int close(int file) {
  REAL(int, "close", int);
  const int failed = is_file_below(file) && fails(CLOSE);
  const int result = real(file);
  if (!failed) return result;
  errno = error_number;
  return -1;
}

int fallocate(int file, int mode, off_t at, off_t size) {
  REAL(int, "fallocate", int, int, off_t, off_t);
  return is_file_below(file) && fails(FALLOCATE) ? -1 : real(file, mode, at, size);
}
int fallocate64(int, int, off_t, off_t) __attribute__((alias("fallocate")));

int open(const char* path, int flags, ...) {
  REAL(int, "open", const char*, int, mode_t);
  va_list list;
  va_start(list, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;
  va_end(list);
  return is_below(path) && fails(OPEN) ? -1 : real(path, flags, mode);
}
int open64(const char*, int, ...) __attribute__((alias("open")));
