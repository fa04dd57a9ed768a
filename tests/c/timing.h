/* The clock of the benchmarks, and their lines `bench <name> <value> <unit>`, medians of several runs. */
#ifndef HELIOTORQUE_TESTS_TIMING_H
#define HELIOTORQUE_TESTS_TIMING_H
#include "fmu.h"

#include <time.h>

enum { RUNS = 7 };

static inline double now_s(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static inline int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline void report(const char *name, double *values, const char *unit) {
    qsort(values, RUNS, sizeof *values, ascending);
    printf("bench %s %.6g %s\n", name, values[RUNS / 2], unit);
    fflush(stdout);
}
#endif
