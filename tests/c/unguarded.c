/* A co-simulation FMU that does not check its arguments: right for masters that follow the standard.

   Its solver steps until it has passed the communication point, which for an infinite or NaN step is never, and
   fmi2FreeFMUstate reads through the pointer it is given. It needs no header of the standard. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef void *component;
typedef void *(*allocate)(size_t, size_t);
typedef struct { void *logger; allocate allocate; void (*release)(void *); } callbacks;
enum { OK, WARNING, DISCARD, ERROR };
enum { U, X, N, M };
static const double SOLVER_STEP = 0.01;

typedef enum { INSTANTIATED, INITIALIZING, STEPPING, TERMINATED, FAILED } mode;

typedef struct {
    mode mode;
    double u, x, time, point, stop;
    int n;
} model;

#define EXPORT __attribute__((visibility("default")))
#define UNSUPPORTED(name, ...) EXPORT int name(__VA_ARGS__) { return ERROR; }

static int fail(model *m) {
    m->mode = FAILED;
    return ERROR;
}

static int close_to(double a, double b) {
    return fabs(a - b) <= 1e-9 * (1.0 + fmax(fabs(a), fabs(b)));
}

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT int fmi2SetDebugLogging(model *m, int on, size_t n, const char *const names[]) {
    (void)m, (void)on, (void)n, (void)names;
    return OK;
}

static void start(model *m) {
    memset(m, 0, sizeof *m);
    m->stop = INFINITY;
}

EXPORT component fmi2Instantiate(const char *name, int kind, const char *guid, const char *resources,
                                 const callbacks *functions, int visible, int logging) {
    (void)resources, (void)functions, (void)visible, (void)logging;
    if (!name || !*name || kind != 1 || strcmp(guid, "{unguarded}") != 0) return NULL;
    model *m = malloc(sizeof *m);
    if (m) start(m);
    return m;
}
EXPORT void fmi2FreeInstance(model *m) { free(m); }

EXPORT int fmi2SetupExperiment(model *m, int has_tolerance, double tolerance, double from, int has_stop, double stop) {
    (void)has_tolerance, (void)tolerance;
    if (m->mode != INSTANTIATED) return fail(m);
    m->time = m->point = from;
    if (has_stop) m->stop = stop;
    return OK;
}
EXPORT int fmi2EnterInitializationMode(model *m) {
    if (m->mode != INSTANTIATED) return fail(m);
    m->mode = INITIALIZING;
    return OK;
}
EXPORT int fmi2ExitInitializationMode(model *m) {
    if (m->mode != INITIALIZING) return fail(m);
    m->mode = STEPPING;
    return OK;
}
EXPORT int fmi2Terminate(model *m) {
    if (m->mode != STEPPING) return fail(m);
    m->mode = TERMINATED;
    return OK;
}
EXPORT int fmi2Reset(model *m) {
    start(m);
    return OK;
}

EXPORT int fmi2GetReal(model *m, const unsigned refs[], size_t n, double values[]) {
    for (size_t i = 0; i < n; i++) {
        if (refs[i] > X) return fail(m);
        values[i] = refs[i] == U ? m->u : m->x;
    }
    return OK;
}
EXPORT int fmi2GetInteger(model *m, const unsigned refs[], size_t n, int values[]) {
    for (size_t i = 0; i < n; i++) {
        if (refs[i] != N && refs[i] != M) return fail(m);
        values[i] = m->n;
    }
    return OK;
}
EXPORT int fmi2SetReal(model *m, const unsigned refs[], size_t n, const double values[]) {
    for (size_t i = 0; i < n; i++) {
        if (refs[i] != U || m->mode >= TERMINATED) return fail(m);
        m->u = values[i];
    }
    return OK;
}
EXPORT int fmi2SetInteger(model *m, const unsigned refs[], size_t n, const int values[]) {
    for (size_t i = 0; i < n; i++) {
        if (refs[i] != N || m->mode >= TERMINATED) return fail(m);
        m->n = values[i];
    }
    return OK;
}
#define NO_VARIABLES(name, type) \
    EXPORT int name(model *m, const unsigned refs[], size_t n, type values[]) { \
        (void)refs, (void)values; \
        return n == 0 ? OK : fail(m); \
    }
NO_VARIABLES(fmi2GetBoolean, int)
NO_VARIABLES(fmi2GetString, const char *)
NO_VARIABLES(fmi2SetBoolean, const int)
NO_VARIABLES(fmi2SetString, const char *const)

EXPORT int fmi2GetFMUstate(model *m, void **state) {
    if (!*state) *state = malloc(sizeof *m);
    memcpy(*state, m, sizeof *m);
    return OK;
}
EXPORT int fmi2SetFMUstate(model *m, void *state) {
    memcpy(m, state, sizeof *m);
    return OK;
}
EXPORT int fmi2FreeFMUstate(model *m, void **state) {
    (void)m;
    free(*state);
    *state = NULL;
    return OK;
}
EXPORT int fmi2SerializedFMUstateSize(model *m, void *state, size_t *size) {
    (void)state;
    *size = sizeof *m;
    return OK;
}
EXPORT int fmi2SerializeFMUstate(model *m, void *state, char bytes[], size_t size) {
    if (size < sizeof *m) return fail(m);
    memcpy(bytes, state, sizeof *m);
    return OK;
}
EXPORT int fmi2DeSerializeFMUstate(model *m, const char bytes[], size_t size, void **state) {
    if (size != sizeof *m) return fail(m);
    if (!*state) *state = malloc(sizeof *m);
    memcpy(*state, bytes, sizeof *m);
    return OK;
}

EXPORT int fmi2DoStep(model *m, double point, double step, int no_state_prior) {
    (void)no_state_prior;
    if (m->mode != STEPPING || !close_to(point, m->point) || step <= 0) return fail(m);
    const double next = point + step;
    if (next > m->stop && !close_to(next, m->stop)) return fail(m);
    for (;;) {
        const double then = m->time + SOLVER_STEP;
        if (then > next && !close_to(then, next)) break;
        m->x += SOLVER_STEP * (m->u + 1.0);
        m->time = then;
    }
    m->point = next;
    return OK;
}

UNSUPPORTED(fmi2GetDirectionalDerivative, model *m, const unsigned *z, size_t nz, const unsigned *v, size_t nv,
            const double *dv, double *dz)
UNSUPPORTED(fmi2SetRealInputDerivatives, model *m, const unsigned *v, size_t n, const int *o, const double *x)
UNSUPPORTED(fmi2GetRealOutputDerivatives, model *m, const unsigned *v, size_t n, const int *o, double *x)
UNSUPPORTED(fmi2CancelStep, model *m)
EXPORT int fmi2GetStatus(model *m, int kind, int *value) { return (void)m, (void)kind, (void)value, DISCARD; }
EXPORT int fmi2GetRealStatus(model *m, int kind, double *value) { return (void)m, (void)kind, (void)value, DISCARD; }
EXPORT int fmi2GetIntegerStatus(model *m, int kind, int *value) { return (void)m, (void)kind, (void)value, DISCARD; }
EXPORT int fmi2GetBooleanStatus(model *m, int kind, int *value) { return (void)m, (void)kind, (void)value, DISCARD; }
EXPORT int fmi2GetStringStatus(model *m, int kind, const char **value) { return (void)m, (void)kind, (void)value, DISCARD; }
