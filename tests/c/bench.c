/* Speed and memory through the C interface: one line `bench <name> <value> <unit>` a figure, medians of several runs. */
#include "timing.h"

#include <math.h>
#include <sys/resource.h>

static void empty_model(const Library *probe) {
    char *xml = description_of(probe, "Empty");
    fmi2Component c = start(probe, xml);
    CHECK(probe->ExitInitializationMode(c) == fmi2OK);
    fmi2ValueReference reference = 0;
    fmi2Real value, values[RUNS];
    const int steps = 2000000;
    double t = 0;
    int status = fmi2OK;
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        for (int i = 0; i < steps; i++, t += 1.0) {
            status |= (int)probe->DoStep(c, t, 1.0, fmi2True);
            status |= (int)probe->GetReal(c, &reference, 1, &value);
        }
        values[run] = (now_s() - begin) / steps * 1e9;
    }
    CHECK(status == fmi2OK);
    report("empty_step_and_get", values, "ns");
    probe->FreeInstance(c);
    free(xml);
}

static void ten_reals(const Library *library, const char *xml) {
    fmi2Component c = start(library, xml);
    fmi2ValueReference in[10], out[10];
    fmi2Real numbers[10], values[RUNS];
    const char *inputs[] = {"torque.applied[1]", "torque.applied[2]", "torque.applied[3]", "force.applied[1]",
                            "force.applied[2]",  "force.applied[3]",  "command.rate[1]",    "command.rate[2]",
                            "command.rate[3]",    "dump.target[1]"};
    const char *outputs[] = {"torque.total[1]",  "torque.total[2]",  "torque.total[3]",  "momentum.body[1]",
                             "momentum.body[2]", "momentum.body[3]", "attitude.rate[1]", "attitude.rate[2]",
                             "attitude.rate[3]", "sun.distance"};
    for (int i = 0; i < 10; i++) in[i] = reference_of(xml, inputs[i]), out[i] = reference_of(xml, outputs[i]);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    const int calls = 1000000;
    int status = fmi2OK;
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        for (int i = 0; i < calls; i++) status |= (int)library->GetReal(c, out, 10, numbers);
        values[run] = (now_s() - begin) / calls * 1e9;
    }
    report("get_10_reals", values, "ns");
    /* Every call changes every value. */
    fmi2Real set[2][10];
    for (int i = 0; i < 10; i++) set[0][i] = 1e-6 * (i + 1), set[1][i] = -set[0][i];
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        for (int i = 0; i < calls; i++) status |= (int)library->SetReal(c, in, 10, set[i & 1]);
        values[run] = (now_s() - begin) / calls * 1e9;
    }
    CHECK(library->GetReal(c, in, 10, numbers) == fmi2OK && memcmp(numbers, set[(calls - 1) & 1], sizeof numbers) == 0);
    CHECK(status == fmi2OK);
    report("set_10_reals", values, "ns");
    library->FreeInstance(c);
}

static void first_step(const Library *library, const char *xml) {
    double values[RUNS];
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        fmi2Component c = start(library, xml);
        CHECK(library->ExitInitializationMode(c) == fmi2OK);
        CHECK(library->DoStep(c, 0, 60, fmi2True) == fmi2OK);
        values[run] = (now_s() - begin) * 1e3;
        library->FreeInstance(c);
    }
    report("momentum_plant_first_step", values, "ms");
}

static void ninety_days(const Library *library, const char *xml) {
    double per_step[RUNS], wall[RUNS];
    const int steps = 129600;
    fmi2ValueReference momentum[3];
    momentum[0] = reference_of(xml, "momentum.body[1]");
    momentum[1] = reference_of(xml, "momentum.body[2]");
    momentum[2] = reference_of(xml, "momentum.body[3]");
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        fmi2Component c = start(library, xml);
        CHECK(library->ExitInitializationMode(c) == fmi2OK);
        double stepping = now_s();
        fmi2Real h[3];
        for (int i = 0; i < steps; i++) {
            CHECK(library->DoStep(c, i * 60.0, 60.0, fmi2True) == fmi2OK);
            CHECK(library->GetReal(c, momentum, 3, h) == fmi2OK);
        }
        per_step[run] = (now_s() - stepping) / steps * 1e9;
        library->FreeInstance(c);
        wall[run] = now_s() - begin;
    }
    report("momentum_plant_step_60s", per_step, "ns");
    report("momentum_plant_90_days", wall, "s");
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("bench momentum_plant_peak_memory %.1f MB\n", (double)usage.ru_maxrss / 1024.0);
}

static char *text_of(const char *folder, const char *file) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    FILE *stream = fopen(path, "rb");
    CHECK(stream && fseek(stream, 0, SEEK_END) == 0);
    long length = ftell(stream);
    CHECK(length > 0);
    rewind(stream);
    char *text = calloc((size_t)length + 1, 1);
    CHECK(text && fread(text, 1, (size_t)length, stream) == (size_t)length);
    fclose(stream);
    return text;
}

/* A year of Mercury in steps of 60 s with every effect: planet light, stored heat, conducting panels, self-shadowing,
   eclipses, gravity gradient, and an orbit that all of this, Mercury's flattening and the Sun's tide act on. */
static void mercury_year(const Library *library, const char *folder, const char *name, int has_outlines) {
    char *setup = text_of(folder, "spacecraft.toml"), *xml = NULL;
    CHECK(library->describe("MomentumPlant", "spacecraft.toml", setup, &xml, keep_text) == 0);
    const char *effects[] = {"planetLight.enabled", "thermal.enabled", "shadowing.enabled"};
    char location[4200];
    snprintf(location, sizeof location, "file://%s", folder);
    const int steps = 126675;
    double wall[RUNS];
    for (int run = 0; run < RUNS; run++) {
        double begin = now_s();
        fmi2Component c = instantiate(library, xml, location);
        CHECK(c);
        /* What has no outlines casts no shadow, and is refused when asked to. */
        for (int i = 0; i < (has_outlines ? 3 : 2); i++) {
            fmi2ValueReference effect = reference_of(xml, effects[i]);
            fmi2Boolean on = fmi2True;
            CHECK(library->SetBoolean(c, &effect, 1, &on) == fmi2OK);
        }
        fmi2ValueReference model = reference_of(xml, "orbit.dynamics");
        fmi2Integer disturbed = 2;
        CHECK(library->SetInteger(c, &model, 1, &disturbed) == fmi2OK);
        CHECK(library->SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
        CHECK(library->EnterInitializationMode(c) == fmi2OK);
        CHECK(library->ExitInitializationMode(c) == fmi2OK);
        for (int i = 0; i < steps; i++) CHECK(library->DoStep(c, i * 60.0, 60.0, fmi2True) == fmi2OK);
        fmi2ValueReference thermal = reference_of(xml, "force.thermal[2]");
        fmi2Real force = 0;
        CHECK(library->GetReal(c, &thermal, 1, &force) == fmi2OK && force != 0);
        library->FreeInstance(c);
        wall[run] = now_s() - begin;
    }
    char line[128];
    snprintf(line, sizeof line, "mercury_year_60s_all_effects_%s", name);
    report(line, wall, "s");
    free(xml);
    free(setup);
}

/* A 50 Hz master that changes a torque from outside at every step. */
static void fifty_hertz(const Library *library, const char *xml, fmi2Boolean effects, const char *name) {
    double per_step[RUNS];
    const int steps = 50000;
    fmi2ValueReference enabled[2], torque = reference_of(xml, "torque.applied[1]");
    enabled[0] = reference_of(xml, "planetLight.enabled");
    enabled[1] = reference_of(xml, "thermal.enabled");
    fmi2Boolean values[2] = {effects, effects};
    for (int run = 0; run < RUNS; run++) {
        fmi2Component c = instantiate(library, xml, NULL);
        CHECK(c && library->SetBoolean(c, enabled, 2, values) == fmi2OK);
        CHECK(library->SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
        CHECK(library->EnterInitializationMode(c) == fmi2OK);
        CHECK(library->ExitInitializationMode(c) == fmi2OK);
        double begin = now_s();
        for (int i = 0; i < steps; i++) {
            fmi2Real value = 1e-9 * (i + 1);
            CHECK(library->SetReal(c, &torque, 1, &value) == fmi2OK);
            CHECK(library->DoStep(c, i * 0.02, 0.02, fmi2True) == fmi2OK);
        }
        per_step[run] = (now_s() - begin) / steps * 1e6;
        library->FreeInstance(c);
    }
    report(name, per_step, "us");
}

/* A fresh SpinPlant, ready to step: its own burn, or no burn at all. */
static fmi2Component fresh_spinner(const Library *library, const char *xml, int burns) {
    fmi2Component c = instantiate(library, xml, NULL);
    fmi2ValueReference plan = reference_of(xml, "burn.plan");
    fmi2Integer external = 4;
    CHECK(c && (burns || library->SetInteger(c, &plan, 1, &external) == fmi2OK));
    CHECK(library->SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(c) == fmi2OK);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    return c;
}

/* Steps of 32 ms from the first pulse of a burn to the last, burn after burn, or of coasting only. Instances are made
   while the clock stands still. */
static void spinner_steps(const Library *library, const char *xml, int burns, const char *name) {
    double rate[RUNS];
    enum { STEPS = 500000, LONGEST_CHUNK = 50000 };
    fmi2ValueReference ends[2], pulses = reference_of(xml, "burn.pulsesFired");
    ends[0] = reference_of(xml, "burn.nextEdge");
    ends[1] = reference_of(xml, "burn.plannedDuration");
    for (int run = 0; run < RUNS; run++) {
        double stepping = 0;
        for (int done = 0; done < STEPS;) {
            fmi2Component c = fresh_spinner(library, xml, burns);
            double t = 0;
            int chunk = STEPS - done < LONGEST_CHUNK ? STEPS - done : LONGEST_CHUNK;
            fmi2Integer fired = 0;
            if (burns) {
                fmi2Real times[2];
                CHECK(library->GetReal(c, ends, 2, times) == fmi2OK && times[0] >= 0 && times[1] > 0);
                if (times[0] > 0) CHECK(library->DoStep(c, 0, times[0], fmi2True) == fmi2OK);
                t = times[0];
                int within = (int)(times[1] / 0.032);
                if (within < chunk) chunk = within;
            }
            double begin = now_s();
            for (int i = 0; i < chunk; i++) CHECK(library->DoStep(c, t + i * 0.032, 0.032, fmi2True) == fmi2OK);
            stepping += now_s() - begin;
            CHECK(library->GetInteger(c, &pulses, 1, &fired) == fmi2OK && (fired > 0) == (burns != 0));
            library->FreeInstance(c);
            done += chunk;
        }
        rate[run] = STEPS / stepping;
    }
    report(name, rate, "1/s");
}

/* Paper 002's 1400 s manoeuvre in one step. */
static void manoeuvre(const Library *library, const char *xml) {
    double values[RUNS];
    fmi2ValueReference nutation = reference_of(xml, "nutation.angle");
    fmi2Real angle;
    for (int run = 0; run < RUNS; run++) {
        fmi2Component c = fresh_spinner(library, xml, 1);
        double begin = now_s();
        CHECK(library->DoStep(c, 0, 1400, fmi2True) == fmi2OK);
        values[run] = (now_s() - begin) * 1e3;
        CHECK(library->GetReal(c, &nutation, 1, &angle) == fmi2OK && angle > 0);
        library->FreeInstance(c);
    }
    report("spin_plant_1400s_in_one_step", values, "ms");
}

/* One choice or number of a command. */
typedef struct {
    const char *name;
    int is_real;
    double value;
} Setting;

/* A sample a second on a circle about the planet, position and velocity set before each. */
static void guidance(const Library *library, const char *xml, const Setting *settings, int count, const char *name) {
    double per_step[RUNS];
    const int steps = 50000;
    const char *names[] = {"position[1]", "position[2]", "position[3]", "velocity[1]", "velocity[2]", "velocity[3]"};
    fmi2ValueReference place[6], q = reference_of(xml, "command.q[1]"), kind = reference_of(xml, "command.kind");
    for (int i = 0; i < 6; i++) place[i] = reference_of(xml, names[i]);
    for (int run = 0; run < RUNS; run++) {
        fmi2Component c = start(library, xml);
        for (int i = 0; i < count; i++) {
            fmi2ValueReference reference = reference_of(xml, settings[i].name);
            fmi2Integer item = (fmi2Integer)settings[i].value;
            if (settings[i].is_real) CHECK(library->SetReal(c, &reference, 1, &settings[i].value) == fmi2OK);
            else CHECK(library->SetInteger(c, &reference, 1, &item) == fmi2OK);
        }
        CHECK(library->ExitInitializationMode(c) == fmi2OK);
        fmi2Real first = 0, last = 0, stepping = 0;
        for (int i = 0; i < steps; i++) {
            double sine = sin(6e-4 * i), cosine = cos(6e-4 * i);
            fmi2Real values[6] = {4e6 * cosine, 1e5, 4e6 * sine, -2.4e3 * sine, 20.0, 2.4e3 * cosine};
            double begin = now_s();
            CHECK(library->SetReal(c, place, 6, values) == fmi2OK);
            CHECK(library->DoStep(c, i, 1.0, fmi2True) == fmi2OK);
            stepping += now_s() - begin;
            if (i == 0) CHECK(library->GetReal(c, &q, 1, &first) == fmi2OK);
        }
        fmi2Integer commanded = 0;
        CHECK(library->GetInteger(c, &kind, 1, &commanded) == fmi2OK && commanded == 1);
        CHECK(library->GetReal(c, &q, 1, &last) == fmi2OK && last != first);
        per_step[run] = stepping / steps * 1e6;
        library->FreeInstance(c);
    }
    report(name, per_step, "us");
}

static void guidance_steps(const Library *library) {
    char *xml = description_of(library, "Guidance");
    const Setting nadir[] = {{"pointing.scenario", 0, 3}};
    const Setting scan[] = {
        {"pointing.scenario", 0, 2},    {"aimpoint.option", 0, 7},      {"aimpoint.latitude", 1, 0.4},
        {"scan.frame", 0, 2},           {"scan.rate[1]", 1, 1e-4},      {"scan.rate[3]", 1, -2e-4},
        {"scan.duration[1]", 1, 100.0}, {"scan.duration[3]", 1, 300.0},
    };
    const Setting orbit_phase[] = {{"pointing.scenario", 0, 10}};
    const Setting lighting[] = {{"pointing.scenario", 0, 2}, {"aimpoint.option", 0, 14}};
#define GUIDANCE(settings, name) guidance(library, xml, settings, (int)(sizeof settings / sizeof *settings), name)
    GUIDANCE(nadir, "guidance_step_1s_nadir");
    GUIDANCE(scan, "guidance_step_1s_latitude_longitude_scan");
    GUIDANCE(orbit_phase, "guidance_step_1s_orbit_phase");
    GUIDANCE(lighting, "guidance_step_1s_optimal_lighting");
#undef GUIDANCE
    free(xml);
}

int main(int count, char **arguments) {
    if (count < 5) {
        fprintf(stderr, "usage: %s libheliotorque libprobe orbiter-folder messenger-folder\n", arguments[0]);
        return 2;
    }
    Library library = open_library(arguments[1]);
    Library probe = open_library(arguments[2]);
    char *xml = description_of(&library, "MomentumPlant");
    ninety_days(&library, xml);
    first_step(&library, xml);
    ten_reals(&library, xml);
    fifty_hertz(&library, xml, fmi2False, "momentum_plant_50_hz_new_torque_each_step");
    fifty_hertz(&library, xml, fmi2True, "momentum_plant_50_hz_new_torque_each_step_light_and_heat");
    free(xml);
    mercury_year(&library, arguments[3], "orbiter", 1);
    mercury_year(&library, arguments[4], "messenger", 0);
    xml = description_of(&library, "SpinPlant");
    spinner_steps(&library, xml, 1, "spin_plant_steps_32ms_in_a_burn");
    spinner_steps(&library, xml, 0, "spin_plant_steps_32ms_coasting");
    manoeuvre(&library, xml);
    free(xml);
    guidance_steps(&library);
    empty_model(&probe);
    return 0;
}
