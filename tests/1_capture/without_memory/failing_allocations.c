/* Preloaded into a program (LD_PRELOAD), this fails its allocations from one number to another, counted over all threads since
   fail_allocations(), which a program finds by dlsym(), or since the program was loaded: FAIL_ALLOCATIONS="FROM TO" in the
   environment does that, and the file COUNTED_ALLOCATIONS then has their number. operator new allocates by malloc(). */
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

static atomic_long first, last, count;
static atomic_int counting;

void fail_allocations(long from, long to) {
    first = from;
    last = to;
    count = 0;
    counting = 1;
}
void pause_failing(void) { counting = 0; }
void go_on_failing(void) { counting = 1; }
long allocations(void) { return count; }

static int fails(void) {
    if (!counting) return 0;
    const long number = atomic_fetch_add(&count, 1) + 1;
    if (number < first || number > last) return 0;
    errno = ENOMEM;
    return 1;
}

void* malloc(size_t bytes) { return fails() ? NULL : __libc_malloc(bytes); }
void* calloc(size_t number, size_t bytes) { return fails() ? NULL : __libc_calloc(number, bytes); }
void* realloc(void* old, size_t bytes) { return fails() ? NULL : __libc_realloc(old, bytes); }
void* memalign(size_t alignment, size_t bytes) { return fails() ? NULL : __libc_memalign(alignment, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** result, size_t alignment, size_t bytes) {
    *result = memalign(alignment, bytes);
    return *result ? 0 : ENOMEM;
}

__attribute__((constructor)) static void begin(void) {
    long from, to;
    const char* numbers = getenv("FAIL_ALLOCATIONS");
    if (numbers && sscanf(numbers, "%ld %ld", &from, &to) == 2) fail_allocations(from, to);
}

__attribute__((destructor)) static void end(void) {
    const char* path = getenv("COUNTED_ALLOCATIONS");
    if (!path) return;
    pause_failing();
    FILE* file = fopen(path, "w");
    if (!file) return;
    fprintf(file, "%ld", (long)count);
    fclose(file);
}
