/* A C master that uses every function once, the way an importer would; run under valgrind in the tests. */
#include "fmu.h"

#include <math.h>
#include <pthread.h>

/* Runs with these Booleans on, watching the vector `watched`. */
static void simulate(const Library *library, const char *xml, const char *watched, double step_s, int steps,
                const char *const *enabled, int enabled_count) {
    fmi2Component c = instantiate(library, xml, NULL);
    CHECK(c);
    for (int i = 0; i < enabled_count; i++) {
        fmi2ValueReference effect = reference_of(xml, enabled[i]);
        fmi2Boolean on = fmi2True;
        CHECK(library->SetBoolean(c, &effect, 1, &on) == fmi2OK);
    }
    CHECK(library->SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(c) == fmi2OK);
    fmi2ValueReference h[3];
    for (int i = 0; i < 3; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s[%d]", watched, i + 1);
        h[i] = reference_of(xml, name);
    }
    fmi2Real at_start[3], halfway[3], end[3], again[3];
    CHECK(library->GetReal(c, h, 3, at_start) == fmi2OK);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    fmi2FMUstate state = NULL;
    for (int i = 0; i < steps; i++) {
        if (i == steps / 2) {
            CHECK(library->GetFMUstate(c, &state) == fmi2OK);
            CHECK(library->GetReal(c, h, 3, halfway) == fmi2OK);
        }
        CHECK(library->DoStep(c, step_s * i, step_s, fmi2True) == fmi2OK);
    }
    CHECK(library->GetReal(c, h, 3, end) == fmi2OK);
    CHECK(isfinite(end[0]) && isfinite(end[1]) && isfinite(end[2]));

    /* Back to the middle through bytes, and to the same end to the bit. */
    size_t size = 0;
    CHECK(library->SerializedFMUstateSize(c, state, &size) == fmi2OK && size > 0);
    fmi2Byte *bytes = malloc(size);
    CHECK(bytes);
    CHECK(library->SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK && state == NULL);
    fmi2Component twin = instantiate(library, xml, NULL);
    CHECK(twin);
    CHECK(library->DeSerializeFMUstate(twin, bytes, size, &state) == fmi2OK);
    free(bytes);
    CHECK(library->SetFMUstate(twin, state) == fmi2OK);
    CHECK(library->GetReal(twin, h, 3, again) == fmi2OK);
    CHECK(memcmp(again, halfway, sizeof again) == 0);
    for (int i = steps / 2; i < steps; i++) CHECK(library->DoStep(twin, step_s * i, step_s, fmi2True) == fmi2OK);
    CHECK(library->GetReal(twin, h, 3, again) == fmi2OK);
    CHECK(memcmp(again, end, sizeof again) == 0);
    CHECK(library->FreeFMUstate(twin, &state) == fmi2OK);

    /* A NaN is discarded and the instance stays usable; a wrong time is an error, and Reset brings the instance back. */
    fmi2ValueReference torque = reference_of(xml, "torque.applied[1]");
    fmi2Real nan_value = NAN;
    CHECK(library->SetReal(twin, &torque, 1, &nan_value) == fmi2Discard);
    CHECK(library->DoStep(twin, step_s * steps, step_s, fmi2True) == fmi2OK);
    CHECK(library->DoStep(twin, 0.3 * step_s, step_s, fmi2True) == fmi2Error);
    CHECK(library->Reset(twin) == fmi2OK);
    CHECK(library->SetupExperiment(twin, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(twin) == fmi2OK);
    CHECK(library->GetReal(twin, h, 3, again) == fmi2OK);
    CHECK(memcmp(again, at_start, sizeof again) == 0);
    CHECK(library->ExitInitializationMode(twin) == fmi2OK);
    CHECK(library->Terminate(twin) == fmi2OK);
    library->FreeInstance(twin);
    CHECK(library->Terminate(c) == fmi2OK);
    library->FreeInstance(c);
}

/* The memoryless model: the planet passes before the Sun, slopes are finite, a state gives the same values again. */
static void place(const Library *library, const char *xml, int steps) {
    fmi2Component c = start(library, xml);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    fmi2ValueReference planet[3] = {reference_of(xml, "planet.positionBody[1]"), reference_of(xml, "planet.positionBody[2]"),
                                    reference_of(xml, "planet.positionBody[3]")};
    fmi2ValueReference outputs[3] = {reference_of(xml, "sun.litFraction"), reference_of(xml, "torque.total[1]"),
                                     reference_of(xml, "torque.total[2]")};
    fmi2FMUstate state = NULL;
    fmi2Real kept[3] = {0}, values[3], slopes[3], along[3] = {1.0, 0.5, -0.25};
    int dark = 0;
    for (int i = 0; i < steps; i++) {
        fmi2Real angle = 6.28318530717958648 * i / steps;
        fmi2Real at[3] = {5e6 * sin(angle), -5e6 * cos(angle), 1e5};
        CHECK(library->SetReal(c, planet, 3, at) == fmi2OK);
        CHECK(library->DoStep(c, 60.0 * i, 60.0, fmi2True) == fmi2OK);
        CHECK(library->GetReal(c, outputs, 3, values) == fmi2OK);
        CHECK(library->GetDirectionalDerivative(c, outputs, 3, planet, 3, along, slopes) == fmi2OK);
        for (int k = 0; k < 3; k++) CHECK(isfinite(values[k]) && isfinite(slopes[k]));
        dark += values[0] == 0.0;
        if (i == steps / 2) {
            CHECK(library->GetFMUstate(c, &state) == fmi2OK);
            memcpy(kept, values, sizeof kept);
        }
    }
    CHECK(dark > 0 && dark < steps);
    CHECK(library->SetFMUstate(c, state) == fmi2OK);
    CHECK(library->GetReal(c, outputs, 3, values) == fmi2OK);
    CHECK(memcmp(values, kept, sizeof kept) == 0);
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK);

    /* Into the planet: an error, and Reset brings the instance back. */
    fmi2Real inside[3] = {1e3, 0.0, 0.0};
    int before = logged_messages;
    CHECK(library->SetReal(c, planet, 3, inside) == fmi2OK);
    CHECK(library->DoStep(c, 60.0 * (steps / 2 + 1), 60.0, fmi2True) == fmi2Error);
    CHECK(logged_messages > before);
    CHECK(library->Reset(c) == fmi2OK);
    library->FreeInstance(c);
}

/* Guidance: nadir on a circle about the planet, a sample a second; a state goes on to the same attitude to the bit. */
static void point(const Library *library, const char *xml, int steps) {
    fmi2Component c = start(library, xml);
    const char *names[] = {"position[1]", "position[2]", "position[3]", "velocity[1]", "velocity[2]", "velocity[3]"};
    fmi2ValueReference place[6], q[4], scenario = reference_of(xml, "pointing.scenario");
    for (int i = 0; i < 6; i++) place[i] = reference_of(xml, names[i]);
    for (int i = 0; i < 4; i++) {
        char name[64];
        snprintf(name, sizeof name, "command.q[%d]", i + 1);
        q[i] = reference_of(xml, name);
    }
    fmi2Integer nadir = 3;
    CHECK(library->SetInteger(c, &scenario, 1, &nadir) == fmi2OK);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    fmi2FMUstate state = NULL;
    fmi2Real first[4] = {0}, end[4] = {0};
    for (int round = 0; round < 2; round++) {
        for (int i = round == 0 ? 0 : steps / 2; i < steps; i++) {
            if (round == 0 && i == steps / 2) CHECK(library->GetFMUstate(c, &state) == fmi2OK);
            double sine = sin(6e-4 * i), cosine = cos(6e-4 * i);
            fmi2Real values[6] = {4e6 * cosine, 1e5, 4e6 * sine, -2.4e3 * sine, 0.0, 2.4e3 * cosine};
            CHECK(library->SetReal(c, place, 6, values) == fmi2OK);
            CHECK(library->DoStep(c, i, 1.0, fmi2True) == fmi2OK);
            if (round == 0 && i == 0) CHECK(library->GetReal(c, q, 4, first) == fmi2OK);
        }
        fmi2Real now[4];
        CHECK(library->GetReal(c, q, 4, now) == fmi2OK);
        CHECK(memcmp(now, first, sizeof now) != 0);
        if (round == 0) memcpy(end, now, sizeof end);
        else CHECK(memcmp(now, end, sizeof now) == 0);
        if (round == 0) CHECK(library->SetFMUstate(c, state) == fmi2OK);
    }
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK);
    fmi2Integer unknown = 99;
    CHECK(library->SetInteger(c, &scenario, 1, &unknown) == fmi2Discard);
    CHECK(library->DoStep(c, steps, 1.0, fmi2True) == fmi2OK);
    library->FreeInstance(c);
}

/* Two threads simulate instances of their own through the same library. */
typedef struct {
    const Library *library;
    const char *xml, *watched;
    double step_s;
    int steps;
} Simulation;

static void *simulate_alone(void *context) {
    const Simulation *simulation = context;
    simulate(simulation->library, simulation->xml, simulation->watched, simulation->step_s, simulation->steps, NULL, 0);
    return NULL;
}

static void simulate_together(const Library *library, int steps) {
    char *plant = description_of(library, "MomentumPlant"), *spinner = description_of(library, "SpinPlant");
    Simulation simulations[] = {{library, plant, "momentum.body", 600.0, steps}, {library, plant, "momentum.body", 600.0, steps},
                      {library, spinner, "attitude.rate", 0.5, steps}};
    pthread_t threads[3];
    for (int i = 0; i < 3; i++) CHECK(pthread_create(&threads[i], NULL, simulate_alone, &simulations[i]) == 0);
    for (int i = 0; i < 3; i++) CHECK(pthread_join(threads[i], NULL) == 0);
    free(plant);
    free(spinner);
}

int main(int count, char **arguments) {
    if (count < 3) {
        fprintf(stderr, "usage: %s libheliotorque libprobe [--short]\n", arguments[0]);
        return 2;
    }
    int short_simulation = count > 3 && strcmp(arguments[3], "--short") == 0;
    Library library = open_library(arguments[1]);
    CHECK(strcmp(library.GetVersion(), "2.0") == 0);
    CHECK(strcmp(library.GetTypesPlatform(), "default") == 0);
    char *xml = description_of(&library, "MomentumPlant");
    simulate(&library, xml, "momentum.body", 600.0, short_simulation ? 40 : 4000, NULL, 0);
    const char *effects[] = {"planetLight.enabled", "thermal.enabled"};
    simulate(&library, xml, "momentum.body", 600.0, short_simulation ? 20 : 1000, effects, 2);
    free(xml);
    xml = description_of(&library, "SpinPlant");
    simulate(&library, xml, "attitude.rate", 0.5, short_simulation ? 60 : 4000, NULL, 0);
    free(xml);
    xml = description_of(&library, "DisturbanceTorque");
    place(&library, xml, short_simulation ? 40 : 4000);
    free(xml);
    xml = description_of(&library, "Guidance");
    point(&library, xml, short_simulation ? 40 : 4000);
    free(xml);
    simulate_together(&library, short_simulation ? 40 : 1000);
    Library probe = open_library(arguments[2]);
    xml = description_of(&probe, "AllTypes");
    fmi2Component c = start(&probe, xml);
    CHECK(probe.ExitInitializationMode(c) == fmi2OK);
    for (int i = 0; i < 100; i++) CHECK(probe.DoStep(c, 0.1 * i, 0.1, fmi2True) == fmi2OK);
    CHECK(probe.Terminate(c) == fmi2OK);
    probe.FreeInstance(c);
    free(xml);
    int before = logged_messages;
    fmi2CallbackFunctions callbacks = {quiet_logger, NULL, NULL, NULL, NULL};
    CHECK(library.Instantiate("x", fmi2CoSimulation, "{no-such-guid}", NULL, &callbacks, fmi2False, fmi2False) == NULL);
    CHECK(logged_messages > before);
    puts("C client: all calls answered as expected");
    return 0;
}
