/* Speed of controlled and free flight through the C interface. */
#include "timing.h"

/* A plant whose body turns by its own dynamics: 3 under the controller, with the orbit phase's own guidance, 4 free. */
static fmi2Component dynamic_plant(const Library *library, const char *xml, fmi2Integer source, fmi2Boolean effects) {
    fmi2Component c = instantiate(library, xml, NULL);
    fmi2ValueReference enabled[2], choices[2];
    enabled[0] = reference_of(xml, "planetLight.enabled");
    enabled[1] = reference_of(xml, "thermal.enabled");
    choices[0] = reference_of(xml, "attitude.source");
    choices[1] = reference_of(xml, "command.source");
    fmi2Boolean on[2] = {effects, effects};
    fmi2Integer items[2] = {source, 2};
    CHECK(c && library->SetBoolean(c, enabled, 2, on) == fmi2OK);
    CHECK(library->SetInteger(c, choices, 2, items) == fmi2OK);
    CHECK(library->SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(c) == fmi2OK);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    return c;
}

enum { CONTROL_RATE = 50, DYNAMIC_SPAN_S = 1200 };

/* Samples of the controller a second of computing, the flight cut into steps of `steps_per_minute` a minute. */
static void controlled(const Library *library, const char *xml, fmi2Boolean effects, int steps_per_minute,
                       const char *name) {
    double rate[RUNS];
    const double step_s = 60.0 / steps_per_minute;
    const int steps = DYNAMIC_SPAN_S / 60 * steps_per_minute;
    fmi2ValueReference error = reference_of(xml, "control.error");
    for (int run = 0; run < RUNS; run++) {
        fmi2Component c = dynamic_plant(library, xml, 3, effects);
        int status = fmi2OK;
        double begin = now_s();
        for (int i = 0; i < steps; i++) status |= (int)library->DoStep(c, i * step_s, step_s, fmi2True);
        rate[run] = DYNAMIC_SPAN_S * CONTROL_RATE / (now_s() - begin);
        fmi2Real angle = 1;
        CHECK(status == fmi2OK && library->GetReal(c, &error, 1, &angle) == fmi2OK && angle > 0 && angle < 1e-3);
        library->FreeInstance(c);
    }
    report(name, rate, "1/s");
}

/* A controller outside: at every step of 20 ms four new wheel torques in, attitude and rate out. */
static void free_flight(const Library *library, const char *xml, fmi2Boolean effects, const char *name) {
    double rate[RUNS];
    const int steps = DYNAMIC_SPAN_S * CONTROL_RATE;
    fmi2ValueReference torques[4], attitude[7];
    for (int i = 0; i < 7; i++) {
        char variable[64];
        snprintf(variable, sizeof variable, i < 4 ? "attitude.q[%d]" : "attitude.rate[%d]", i < 4 ? i + 1 : i - 3);
        attitude[i] = reference_of(xml, variable);
        snprintf(variable, sizeof variable, "wheel[%d].torqueCommand", i + 1);
        if (i < 4) torques[i] = reference_of(xml, variable);
    }
    for (int run = 0; run < RUNS; run++) {
        fmi2Component c = dynamic_plant(library, xml, 4, effects);
        int status = fmi2OK;
        fmi2Real out[7] = {0};
        double begin = now_s();
        for (int i = 0; i < steps; i++) {
            double torque = 1e-4 * (i % 100 - 50 + 1e-3 * (i & 1));
            fmi2Real in[4] = {torque, -torque, 0.5 * torque, 0.7 * torque};
            status |= (int)library->SetReal(c, torques, 4, in);
            status |= (int)library->DoStep(c, i * 0.02, 0.02, fmi2True);
            status |= (int)library->GetReal(c, attitude, 7, out);
        }
        rate[run] = steps / (now_s() - begin);
        CHECK(status == fmi2OK && out[4] != 0);
        library->FreeInstance(c);
    }
    report(name, rate, "1/s");
}

int main(int count, char **arguments) {
    if (count < 2) {
        fprintf(stderr, "usage: %s libheliotorque\n", arguments[0]);
        return 2;
    }
    Library plant = open_library(arguments[1]);
    const Library *library = &plant;
    char *xml = description_of(library, "MomentumPlant");
    controlled(library, xml, fmi2False, 3000, "momentum_plant_controlled_periods_20ms_in_steps_of_20ms");
    controlled(library, xml, fmi2False, 60, "momentum_plant_controlled_periods_20ms_in_steps_of_1s");
    controlled(library, xml, fmi2False, 1, "momentum_plant_controlled_periods_20ms_in_steps_of_60s");
    controlled(library, xml, fmi2True, 3000, "momentum_plant_controlled_periods_20ms_in_steps_of_20ms_light_and_heat");
    controlled(library, xml, fmi2True, 60, "momentum_plant_controlled_periods_20ms_in_steps_of_1s_light_and_heat");
    controlled(library, xml, fmi2True, 1, "momentum_plant_controlled_periods_20ms_in_steps_of_60s_light_and_heat");
    free_flight(library, xml, fmi2False, "momentum_plant_free_steps_20ms_new_torques");
    free_flight(library, xml, fmi2True, "momentum_plant_free_steps_20ms_new_torques_light_and_heat");
    free(xml);
    return 0;
}
