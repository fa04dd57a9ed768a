/* Preloaded into the command line: from the n-th write to a regular file on, the disk is full.
 *
 * FULL_DISK_FROM holds n, counted from 1 in each process; writes to pipes and terminals go on. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static long written;

static int is_full(int file) {
    const char *from = getenv("FULL_DISK_FROM");
    struct stat what;
    if (!from || fstat(file, &what) != 0 || !S_ISREG(what.st_mode)) return 0;
    if (__atomic_add_fetch(&written, 1, __ATOMIC_RELAXED) < atol(from)) return 0;
    errno = ENOSPC;
    return 1;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void *bytes, size_t count) {
    return is_full(file) ? -1 : NEXT(write)(file, bytes, count);
}
ssize_t writev(int file, const struct iovec *parts, int count) {
    return is_full(file) ? -1 : NEXT(writev)(file, parts, count);
}
ssize_t pwrite64(int file, const void *bytes, size_t count, off64_t at) {
    return is_full(file) ? -1 : NEXT(pwrite64)(file, bytes, count, at);
}
ssize_t sendfile64(int to, int from, off64_t *at, size_t count) {
    return is_full(to) ? -1 : NEXT(sendfile64)(to, from, at, count);
}
ssize_t copy_file_range(int from, off64_t *at, int to, off64_t *to_at, size_t count, unsigned flags) {
    return is_full(to) ? -1 : NEXT(copy_file_range)(from, at, to, to_at, count, flags);
}
