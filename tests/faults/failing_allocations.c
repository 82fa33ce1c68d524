/* Preloaded into a program: makes allocations of memory fail.
 *
 *   FAULT_COUNT   file that gets the number of allocations when the program ends
 *   FAULT         K: the K-th one fails; K+: all from there on
 *   FAULT_SIZE    only those of at least so many bytes are counted
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

static atomic_long count;
static long first = -1;
static size_t smallest;
static int sticky, ready;
static pid_t owner;

static void read_environment(void) {
  const char* fault = getenv("FAULT");
  const char* size = getenv("FAULT_SIZE");
  char* rest = NULL;
  if (fault) first = strtol(fault, &rest, 10);
  sticky = rest && *rest == '+';
  smallest = size ? strtoul(size, NULL, 10) : 0;
  owner = getpid();
  ready = 1;
}

static int fails(size_t size) {
  if (!ready) read_environment();
  if (size < smallest) return 0;
  const long k = ++count;
  if (first < 0 || k < first || (!sticky && k > first)) return 0;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) { return fails(size) ? NULL : __libc_malloc(size); }
void* calloc(size_t n, size_t size) { return fails(n * size) ? NULL : __libc_calloc(n, size); }
void* realloc(void* p, size_t size) { return fails(size) ? NULL : __libc_realloc(p, size); }
void* memalign(size_t a, size_t size) { return fails(size) ? NULL : __libc_memalign(a, size); }
void* aligned_alloc(size_t a, size_t size) { return memalign(a, size); }
int posix_memalign(void** out, size_t a, size_t size) {
  void* memory = memalign(a, size);
  if (!memory) return ENOMEM;
  *out = memory;
  return 0;
}

__attribute__((destructor)) static void end(void) {
  const char* path = getenv("FAULT_COUNT");
  FILE* file = path && getpid() == owner ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", (long)count);
  fclose(file);
}
