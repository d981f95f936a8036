/* Preloaded into a program (LD_PRELOAD), this fails its allocations from one number to another, counted over all threads since
   fail_allocations(), which a program finds by dlsym(), or since the program was loaded: FAIL_ALLOCATIONS="FROM TO" in the
   environment does that, and the file COUNTED_ALLOCATIONS then has their number. operator new allocates by malloc(). With
   FAIL_IN_PROGRAM in the environment, what libraries allocate, drivers among them, neither counts nor fails: only operator new does
   where the program itself calls it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

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

/* The program's code, where nothing else counts. */
static uintptr_t program_begin, program_end;
static _Thread_local int next_fails;

static int fails_in_library(void) {
    if (!program_end) return fails();
    const int it_does = next_fails;
    next_fails = 0;
    if (it_does) errno = ENOMEM;
    return it_does;
}

void* malloc(size_t bytes) { return fails_in_library() ? NULL : __libc_malloc(bytes); }
void* calloc(size_t number, size_t bytes) { return fails_in_library() ? NULL : __libc_calloc(number, bytes); }
void* realloc(void* old, size_t bytes) { return fails_in_library() ? NULL : __libc_realloc(old, bytes); }
void* memalign(size_t alignment, size_t bytes) { return fails_in_library() ? NULL : __libc_memalign(alignment, bytes); }

/* Static objects of a library that is being loaded may allocate by functions of templates that the program has, too. */
static _Thread_local int libraries_loading;
void* dlopen(const char* path, int mode) {
    static void* (*of_library)(const char*, int);
    if (!of_library) of_library = (void* (*)(const char*, int))dlsym(RTLD_NEXT, "dlopen");
    ++libraries_loading;
    void* library = of_library(path, mode);
    --libraries_loading;
    return library;
}

/* The library's operator new throws where malloc() fails. */
static void let_new_fail(void* caller) {
    const uintptr_t address = (uintptr_t)caller;
    if (!libraries_loading && address >= program_begin && address < program_end && fails()) next_fails = 1;
}
void* _Znwm(size_t bytes) { /* operator new(std::size_t) */
    static void* (*of_library)(size_t);
    if (!of_library) of_library = (void* (*)(size_t))dlsym(RTLD_NEXT, "_Znwm");
    let_new_fail(__builtin_return_address(0));
    return of_library(bytes);
}
void* _Znam(size_t bytes) { /* operator new[](std::size_t) */
    static void* (*of_library)(size_t);
    if (!of_library) of_library = (void* (*)(size_t))dlsym(RTLD_NEXT, "_Znam");
    let_new_fail(__builtin_return_address(0));
    return of_library(bytes);
}

/* Finds the code of the first object, which is the program. */
static int find_code(struct dl_phdr_info* object, size_t size, void* unused) {
    (void)size, (void)unused;
    for (int i = 0; i < object->dlpi_phnum; ++i)
        if (object->dlpi_phdr[i].p_type == PT_LOAD && (object->dlpi_phdr[i].p_flags & PF_X)) {
            program_begin = object->dlpi_addr + object->dlpi_phdr[i].p_vaddr;
            program_end = program_begin + object->dlpi_phdr[i].p_memsz;
        }
    return 1;
}

void* aligned_alloc(size_t alignment, size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** result, size_t alignment, size_t bytes) {
    *result = memalign(alignment, bytes);
    return *result ? 0 : ENOMEM;
}

__attribute__((constructor)) static void begin(void) {
    long from, to;
    const char* numbers = getenv("FAIL_ALLOCATIONS");
    if (getenv("FAIL_IN_PROGRAM")) dl_iterate_phdr(find_code, NULL);
    if (!numbers || sscanf(numbers, "%ld %ld", &from, &to) != 2) return;
    alarm(60); /* what hangs is ended */
    fail_allocations(from, to);
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
