/* An FMU that misbehaves: what it does is chosen by -DBEHAVIOUR=..., where by -DAT_LOADING, -DIN_DESCRIBE,
   -DIN_INSTANTIATE or -DIN_STEP, or -DIN_STEP_IF the parameter trouble (reference 1) is above 0.5.
   One Real output x with reference 0, which is the time; steps from 3 s on do the behaviour. With -DKEEPS a reset forgets nothing:
   x is the number of steps since the instance was made; with -DCARRIES it is 1 more once a run with trouble was reset. -DIN_RESET_IF
   does the behaviour at the reset after such a run, -DUNDEFINED makes a library that cannot be loaded. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>
#ifdef _WIN32
#include <windows.h>
#endif

#define EXITS 1
#define CRASHES 2
#define SLEEPS 3
#define SPINS 4
#define PRINTS 5
#define FORKS 6
#define ALLOCATES 7
#define ANSWERS_NAN 8
#define OPENS 9
#define LIES 10
#define RETURNS_TWICE 11
#define STAINS 12
#define ABORTS 13
#define FAILS 14
#define DETACHES 15
#define TOUCHES 16
#define DIES 17

typedef void *Component;
typedef void (*Logger)(void *, const char *, int, const char *, const char *, ...);
typedef struct {
    Logger logger;
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks;

static double now, trouble, carried;
static int steps;
static Callbacks callbacks;
static volatile int forever = 1;
static int *volatile nowhere = NULL;

#ifdef _WIN32
/* A process that never runs, so it does not end by itself either: this program, suspended. It keeps what it inherits. */
static int leave_process(DWORD flags) {
    char program[MAX_PATH];
    STARTUPINFOA start = {sizeof start};
    PROCESS_INFORMATION made;
    GetModuleFileNameA(NULL, program, sizeof program);
    return CreateProcessA(program, NULL, NULL, NULL, TRUE, CREATE_SUSPENDED | flags, NULL, NULL, &start, &made);
}
#endif

static int behaviour(void) {
    switch (BEHAVIOUR) {
    case EXITS: exit(0);
    case CRASHES: *nowhere = 1; break;
    case ABORTS: abort();
    case FAILS: return 3;
    /* As if killed from outside, as long as the environment says so. */
    case DIES: if (getenv("HOSTILE_DIES")) raise(SIGKILL); break;
    case SLEEPS: for (;;) sleep(1000);
    case SPINS: while (forever) {} break;
    case PRINTS: for (;;) { puts("and on and on and on and on and on and on and on and on and on"); }
#ifdef _WIN32
    case FORKS:
        if (!leave_process(0)) abort();
        break;
    case DETACHES:
        /* Out of its job, if it may. */
        if (!leave_process(DETACHED_PROCESS | CREATE_BREAKAWAY_FROM_JOB) && !leave_process(DETACHED_PROCESS)) abort();
        break;
#else
    case FORKS:
        /* The grandchild keeps every file open, also those that its parent would be waited for by. */
        if (fork() == 0) { for (;;) sleep(1000); }
        break;
    case OPENS: {
        int count = 0;
        while (open("/dev/zero", O_RDONLY) >= 0) count++;
        fprintf(stderr, "it could open %d files\n", count);
        abort();
    }
    case DETACHES:
        /* A daemon: in a session of its own, its parent gone. */
        if (fork() == 0) {
            setsid();
            if (fork() == 0) { for (;;) sleep(1000); }
            _exit(0);
        }
        usleep(100000);
        break;
    case RETURNS_TWICE: if (fork() < 0) abort(); break;
#endif
    case ALLOCATES:
        for (long blocks = 0;; blocks++) {
            if (!malloc((size_t)64 << 20)) {
                fprintf(stderr, "it could allocate %ld blocks\n", blocks);
                abort();
            }
        }
    case TOUCHES:
        for (long blocks = 0;; blocks++) {
            char *block = malloc((size_t)64 << 20);
            if (!block) {
                fprintf(stderr, "it could allocate %ld blocks\n", blocks);
                abort();
            }
            memset(block, 1, (size_t)64 << 20);
        }
    case LIES: {
        const char *lie = "ok everything is fine\nfinished\n";
        /* Into every file that is open, so also into whatever tells results. */
        for (int file = 1; file < 256; file++) {
            if (write(file, lie, strlen(lie)) < 0) continue;
        }
        _exit(0);
    }
    case STAINS:
        printf("\033[2Jcleared\a\n");
        fflush(stdout);
        if (callbacks.logger) callbacks.logger(callbacks.environment, "x", 3, "logStatusError", "\033]0;title\a a\rb");
        return 3;
    }
    return 0;
}

#ifdef UNDEFINED
extern int defined_nowhere(void);
int use_of_it(void) { return defined_nowhere(); }
#endif

#ifdef AT_LOADING
__attribute__((constructor)) static void at_loading(void) { behaviour(); }
#endif

#ifdef IN_DESCRIBE
int fmi_export_describe(const char *model, const char *file, const char *setup, void *context, void *receive) {
    (void)model; (void)file; (void)setup; (void)context; (void)receive;
    behaviour();
    return 1;
}
#endif

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
int fmi2SetDebugLogging(Component c, int on, size_t n, const char *const *names) { (void)c; (void)on; (void)n; (void)names; return 0; }
Component fmi2Instantiate(const char *name, int type, const char *guid, const char *where, const Callbacks *given, int visible, int on) {
    (void)name; (void)type; (void)guid; (void)where; (void)visible; (void)on;
    callbacks = *given;
    steps = 0;
    trouble = 0;
#ifdef IN_INSTANTIATE
    behaviour();
#endif
    return &now;
}
void fmi2FreeInstance(Component c) { (void)c; }
int fmi2SetupExperiment(Component c, int has, double tolerance, double start, int stops, double stop) {
    (void)c; (void)has; (void)tolerance; (void)stops; (void)stop;
    now = start;
    return 0;
}
int fmi2EnterInitializationMode(Component c) { (void)c; return 0; }
int fmi2ExitInitializationMode(Component c) { (void)c; return 0; }
int fmi2Terminate(Component c) { (void)c; return 0; }
int fmi2Reset(Component c) {
    (void)c;
    double before = trouble;
    trouble = 0;
    (void)before;
#ifdef CARRIES
    if (before > 0.5) carried = 1;
#endif
#ifdef IN_RESET_IF
    if (before > 0.5) {
        int status = behaviour();
        if (status) return status;
    }
#endif
    return 0;
}
int fmi2GetReal(Component c, const unsigned *references, size_t n, double *values) {
    (void)c;
    for (size_t i = 0; i < n; i++) {
        values[i] = BEHAVIOUR == ANSWERS_NAN && now >= 3 ? 0.0 / (now - now) : references[i] == 1 ? trouble : now;
        if (references[i] == 0) values[i] += carried;
#ifdef KEEPS
        if (references[i] == 0) values[i] = steps;
#endif
    }
    return 0;
}
int fmi2SetReal(Component c, const unsigned *references, size_t n, const double *values) {
    (void)c;
    for (size_t i = 0; i < n; i++) if (references[i] == 1) trouble = values[i];
    return 0;
}
int fmi2DoStep(Component c, double time, double step, int no) {
    (void)c; (void)no;
#ifdef IN_STEP
    if (time >= 3) {
        int status = behaviour();
        if (status) return status;
    }
#endif
#ifdef IN_STEP_IF
    if (time >= 3 && trouble > 0.5) {
        int status = behaviour();
        if (status) return status;
    }
#endif
    now = time + step;
    steps++;
    return 0;
}
#define NOTHING(name) int fmi2##name(Component c) { (void)c; return 0; }
NOTHING(GetInteger) NOTHING(GetBoolean) NOTHING(GetString) NOTHING(SetInteger) NOTHING(SetBoolean)
NOTHING(SetString) NOTHING(GetFMUstate) NOTHING(SetFMUstate) NOTHING(FreeFMUstate) NOTHING(SerializedFMUstateSize)
NOTHING(SerializeFMUstate) NOTHING(DeSerializeFMUstate) NOTHING(GetDirectionalDerivative)
NOTHING(SetRealInputDerivatives) NOTHING(GetRealOutputDerivatives) NOTHING(CancelStep) NOTHING(GetStatus)
NOTHING(GetRealStatus) NOTHING(GetIntegerStatus) NOTHING(GetBooleanStatus) NOTHING(GetStringStatus)
