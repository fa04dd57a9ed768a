/* Many flights with one instance, as a program written for them would do: reset, set, initialize, one step of ten days, get. Takes the
   library and a table of Reals, `run,<names>`, and writes what it gets as CSV to the standard output; the processor time of a flight
   goes to stderr. */
#include "fmu.h"

#include <time.h>

enum { MOST = 16, OUTPUTS = 3 };

static double processor_s(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int main(int count, char **arguments) {
    CHECK(count == 3);
    Library library = open_library(arguments[1]);
    char *xml = description_of(&library, "MomentumPlant");
    FILE *table = fopen(arguments[2], "r");
    CHECK(table);
    char line[4096];
    CHECK(fgets(line, sizeof line, table));
    fmi2ValueReference set[MOST], got[OUTPUTS];
    fmi2Real values[MOST], outputs[OUTPUTS];
    size_t columns = 0;
    CHECK(strtok(line, ",\n"));
    for (char *name; (name = strtok(NULL, ",\n"));) {
        CHECK(columns < MOST);
        set[columns++] = reference_of(xml, name);
    }
    got[0] = reference_of(xml, "momentum.body[1]");
    got[1] = reference_of(xml, "momentum.body[2]");
    got[2] = reference_of(xml, "momentum.body[3]");
    fmi2Component c = instantiate(&library, xml, NULL);
    CHECK(c);
    int flights = 0;
    const double span_s = 864000;
    double begin = processor_s();
    for (; fgets(line, sizeof line, table); flights++) {
        CHECK(strtok(line, ",\n"));
        for (size_t k = 0; k < columns; k++) values[k] = strtod(strtok(NULL, ",\n"), NULL);
        if (flights > 0) CHECK(library.Reset(c) == fmi2OK);
        CHECK(library.SetReal(c, set, columns, values) == fmi2OK);
        CHECK(library.SetupExperiment(c, fmi2False, 0, 0, fmi2True, span_s) == fmi2OK);
        CHECK(library.EnterInitializationMode(c) == fmi2OK);
        CHECK(library.ExitInitializationMode(c) == fmi2OK);
        CHECK(library.DoStep(c, 0, span_s, fmi2True) == fmi2OK);
        CHECK(library.GetReal(c, got, OUTPUTS, outputs) == fmi2OK);
        CHECK(library.Terminate(c) == fmi2OK);
        printf("%d,%.17g,%.17g,%.17g\n", flights, outputs[0], outputs[1], outputs[2]);
    }
    fprintf(stderr, "%.6g\n", (processor_s() - begin) / flights);
    library.FreeInstance(c);
    free(xml);
    fclose(table);
    return 0;
}
