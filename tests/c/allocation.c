/* The n-th allocation fails, for one n after another, each in a process of its own.
 *
 * usage: allocation libheliotorque model step_s [most]
 *
 * The client defines malloc and its kin, so the library allocates through it. A call may answer with an error, or the
 * process may end the way Rust documents for memory that cannot be had: abort after "memory allocation of N bytes
 * failed". Any other end is a fault. */
#include "fmu.h"

#include <errno.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *block, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

static int counting;
static long requested, failing;

/* Whether this allocation is the one that fails. */
static int fails(void) {
    if (!counting || ++requested != failing) return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return fails() ? NULL : __libc_calloc(count, size); }
void *realloc(void *block, size_t size) { return fails() ? NULL : __libc_realloc(block, size); }
void *aligned_alloc(size_t alignment, size_t size) { return fails() ? NULL : __libc_memalign(alignment, size); }
int posix_memalign(void **block, size_t alignment, size_t size) {
    if (fails()) return ENOMEM;
    *block = __libc_memalign(alignment, size);
    return *block ? 0 : ENOMEM;
}

/* Start, steps, a saved state and its bytes, an end; stops at the first call that is refused. */
static fmi2Status simulation(const Library *library, const char *xml, double step_s) {
    static fmi2Byte bytes[1 << 20];
    fmi2Component c = instantiate(library, xml, NULL);
    if (!c) return fmi2Error;
    fmi2FMUstate state = NULL;
    size_t size = 0;
    fmi2Status worst = fmi2OK;
#define CALL(call)                                    \
    do {                                              \
        fmi2Status status = library->call;            \
        if (status > worst) worst = status;           \
    } while (0)
    CALL(SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0));
    CALL(EnterInitializationMode(c));
    CALL(ExitInitializationMode(c));
    for (int i = 0; i < 3; i++) CALL(DoStep(c, step_s * i, step_s, fmi2True));
    CALL(GetFMUstate(c, &state));
    CALL(SerializedFMUstateSize(c, state, &size));
    CHECK(size <= sizeof bytes);
    CALL(SerializeFMUstate(c, state, bytes, size));
    if (state) CALL(FreeFMUstate(c, &state));
    CALL(DeSerializeFMUstate(c, bytes, size, &state));
    if (state) CALL(SetFMUstate(c, state));
    if (state) CALL(FreeFMUstate(c, &state));
    CALL(Reset(c));
    library->FreeInstance(c);
    return worst;
}

int main(int count, char **arguments) {
    if (count < 4) {
        fprintf(stderr, "usage: %s libheliotorque model step_s [most]\n", arguments[0]);
        return 2;
    }
    Library library = open_library(arguments[1]);
    char *xml = description_of(&library, arguments[2]);
    double step_s = atof(arguments[3]);
    long most = count > 4 ? atol(arguments[4]) : 1000;
    /* The first simulation warms up what is allocated once. */
    CHECK(simulation(&library, xml, step_s) == fmi2OK);
    counting = 1;
    CHECK(simulation(&library, xml, step_s) == fmi2OK);
    counting = 0;
    long all = requested, tried = 0, aborted = 0, answered = 0;
    CHECK(all > 0);
    long stride = all / most + 1;
    for (long n = 1; n <= all; n += stride) {
        int ends[2];
        CHECK(pipe(ends) == 0);
        pid_t child = fork();
        CHECK(child >= 0);
        if (child == 0) {
            dup2(ends[1], 2);
            alarm(60);
            requested = 0, failing = n, counting = 1;
            fmi2Status worst = simulation(&library, xml, step_s);
            counting = 0;
            CHECK(requested >= n);
            _exit(worst == fmi2OK ? 10 : 11);
        }
        close(ends[1]);
        char text[4096];
        size_t length = 0;
        ssize_t got;
        while (length < sizeof text - 1 && (got = read(ends[0], text + length, sizeof text - 1 - length)) > 0)
            length += (size_t)got;
        text[length] = 0;
        close(ends[0]);
        int status;
        CHECK(waitpid(child, &status, 0) == child);
        int lawful_abort = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT && strstr(text, "memory allocation of");
        int lawful_answer = WIFEXITED(status) && (WEXITSTATUS(status) == 10 || WEXITSTATUS(status) == 11);
        if (!lawful_abort && !lawful_answer) {
            fprintf(stderr, "%s: allocation %ld of %ld fails: status %#x, %s\n", arguments[2], n, all, status, text);
            return 1;
        }
        tried++, aborted += lawful_abort, answered += lawful_answer;
    }
    printf("%s: %ld of %ld allocations failed in turn: %ld answered, %ld ended by the documented abort\n",
           arguments[2], tried, all, answered, aborted);
    free(xml);
    return 0;
}
