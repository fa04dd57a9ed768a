/* A simulation of an unpacked FMU, its default experiment or so many steps of it: for every output a digest of its bits at all communication
 * points (FNV-1a, 64 bits) and its last value. What two platforms print is equal where their results are. */
#include "fmu.h"

#include <math.h>
#include <stdint.h>

enum { MAX_OUTPUTS = 2048, MAX_COLUMNS = 512, MAX_SETS = 32 };

typedef enum { REAL_TYPE, INTEGER_TYPE, BOOLEAN_TYPE, TEXT_TYPE } Type;

typedef struct {
    char name[256];
    fmi2ValueReference reference;
    Type type;
    uint64_t digest;
    double last;
} Variable;

/* Inputs over time: rows of a CSV, each set once when the time has come to its first column. */
typedef struct {
    char *text, *next;
    Variable columns[MAX_COLUMNS];
    int count;
} Inputs;

typedef struct {
    const char *library, *description, *resources, *inputs, *save, *restore;
    const char *sets[MAX_SETS];
    int set_count;
    long steps;
} Options;

static char *read_file(const char *path, const char *mode, size_t *size) {
    FILE *file = fopen(path, mode);
    if (!file) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(1);
    }
    size_t length = 0, room = 1 << 16, got;
    char *bytes = malloc(room + 1);
    CHECK(bytes);
    while ((got = fread(bytes + length, 1, room - length, file)) > 0) {
        length += got;
        if (length == room) CHECK(bytes = realloc(bytes, (room *= 2) + 1));
    }
    fclose(file);
    bytes[length] = 0;
    if (size) *size = length;
    return bytes;
}

/* Reads the variable that begins at `element`. */
static Variable variable_at(const char *element) {
    Variable variable = {.digest = 0xcbf29ce484222325u};
    snprintf(variable.name, sizeof variable.name, "%s", attribute_after(element, "name"));
    variable.reference = (fmi2ValueReference)strtoul(attribute_after(element, "valueReference"), NULL, 10);
    const char *type = strchr(strchr(element, '>'), '<') + 1;
    variable.type = !strncmp(type, "Real", 4) ? REAL_TYPE : !strncmp(type, "Boolean", 7) ? BOOLEAN_TYPE : !strncmp(type, "String", 6) ? TEXT_TYPE : INTEGER_TYPE;
    return variable;
}

static Variable variable_called(const char *xml, const char *name) {
    char key[320];
    snprintf(key, sizeof key, "<ScalarVariable name=\"%s\"", name);
    const char *element = strstr(xml, key);
    if (!element) {
        fprintf(stderr, "no variable %s\n", name);
        exit(1);
    }
    return variable_at(element);
}

static int outputs_of(const char *xml, Variable *outputs) {
    int count = 0;
    for (const char *element = xml; (element = strstr(element, "<ScalarVariable ")); element++) {
        const char *end = strchr(element, '>'), *causality = strstr(element, " causality=\"output\"");
        if (!causality || causality > end) continue;
        CHECK(count < MAX_OUTPUTS);
        outputs[count++] = variable_at(element);
    }
    CHECK(count > 0);
    return count;
}

static void set(const Library *library, fmi2Component c, const Variable *variable, const char *text) {
    fmi2Real real = strtod(text, NULL);
    fmi2Integer integer = !strcmp(text, "true") ? 1 : (fmi2Integer)real;
    fmi2Status status = variable->type == REAL_TYPE      ? library->SetReal(c, &variable->reference, 1, &real)
                        : variable->type == BOOLEAN_TYPE ? library->SetBoolean(c, &variable->reference, 1, &integer)
                        : variable->type == INTEGER_TYPE ? library->SetInteger(c, &variable->reference, 1, &integer)
                                                    : fmi2Error;
    if (status != fmi2OK) {
        fprintf(stderr, "%s=%s: status %d\n", variable->name, text, status);
        exit(1);
    }
}

static void open_inputs(Inputs *inputs, const char *xml, const char *path) {
    inputs->text = read_file(path, "r", NULL);
    inputs->next = strchr(inputs->text, '\n');
    CHECK(inputs->next);
    *inputs->next++ = 0;
    for (char *name = strtok(inputs->text, ",\r"); (name = strtok(NULL, ",\r"));) {
        CHECK(inputs->count < MAX_COLUMNS);
        inputs->columns[inputs->count++] = variable_called(xml, name);
    }
}

static void set_inputs(Inputs *inputs, const Library *library, fmi2Component c, double time_s) {
    while (inputs->next && *inputs->next && strtod(inputs->next, NULL) <= time_s) {
        char *row = inputs->next, *end = strchr(row, '\n');
        inputs->next = end ? end + 1 : NULL;
        if (end) *end = 0;
        CHECK(strtok(row, ",\r"));
        for (int i = 0; i < inputs->count; i++) {
            const char *value = strtok(NULL, ",\r");
            CHECK(value);
            set(library, c, &inputs->columns[i], value);
        }
    }
}

static void digest(Variable *variable, const void *bytes, size_t length) {
    for (size_t i = 0; i < length; i++) variable->digest = (variable->digest ^ ((const uint8_t *)bytes)[i]) * 0x100000001b3u;
}

static void take(const Library *library, fmi2Component c, Variable *variable) {
    fmi2Real real = 0;
    fmi2Integer integer = 0;
    fmi2String text = "";
    switch (variable->type) {
    case REAL_TYPE:
        CHECK(library->GetReal(c, &variable->reference, 1, &real) == fmi2OK);
        digest(variable, &real, sizeof real);
        break;
    case TEXT_TYPE:
        CHECK(library->GetString(c, &variable->reference, 1, &text) == fmi2OK);
        digest(variable, text, strlen(text));
        break;
    case BOOLEAN_TYPE:
    case INTEGER_TYPE:
        CHECK((variable->type == BOOLEAN_TYPE ? library->GetBoolean : library->GetInteger)(c, &variable->reference, 1, &integer) == fmi2OK);
        digest(variable, &integer, sizeof integer);
        real = integer;
    }
    variable->last = real;
}

static void save(const Library *library, fmi2Component c, const char *path) {
    fmi2FMUstate state = NULL;
    size_t size = 0;
    CHECK(library->GetFMUstate(c, &state) == fmi2OK);
    CHECK(library->SerializedFMUstateSize(c, state, &size) == fmi2OK);
    fmi2Byte *bytes = malloc(size);
    CHECK(bytes && library->SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK);
    FILE *file = fopen(path, "wb");
    CHECK(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
    free(bytes);
}

static void restore(const Library *library, fmi2Component c, const char *path) {
    size_t size = 0;
    char *bytes = read_file(path, "rb", &size);
    fmi2FMUstate state = NULL;
    CHECK(library->DeSerializeFMUstate(c, bytes, size, &state) == fmi2OK);
    CHECK(library->SetFMUstate(c, state) == fmi2OK);
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK);
    free(bytes);
}

static Options options_of(int count, char **arguments) {
    CHECK(count >= 4);
    Options options = {.library = arguments[1], .description = arguments[2], .resources = arguments[3]};
    for (int i = 4; i < count; i += 2) {
        const char *option = arguments[i], *value = arguments[i + 1];
        CHECK(value);
        if (!strcmp(option, "--steps")) options.steps = strtol(value, NULL, 10);
        else if (!strcmp(option, "--inputs")) options.inputs = value;
        else if (!strcmp(option, "--save")) options.save = value;
        else if (!strcmp(option, "--restore")) options.restore = value;
        else {
            CHECK(!strcmp(option, "--set") && options.set_count < MAX_SETS);
            options.sets[options.set_count++] = value;
        }
    }
    return options;
}

static fmi2Component initialized(const Library *library, const char *xml, const Options *options, Inputs *inputs, double start_s) {
    fmi2Component c = instantiate(library, xml, options->resources);
    CHECK(c);
    for (int i = 0; i < options->set_count; i++) {
        char name[256];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(options->sets[i], "="), options->sets[i]);
        const char *value = strchr(options->sets[i], '=');
        CHECK(value);
        Variable variable = variable_called(xml, name);
        set(library, c, &variable, value + 1);
    }
    CHECK(library->SetupExperiment(c, fmi2False, 0, start_s, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(c) == fmi2OK);
    set_inputs(inputs, library, c, start_s);
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    return c;
}

static Variable outputs[MAX_OUTPUTS];

/* With --save the state at half the time goes into a file, with --restore it comes from there; digests are of what follows. */
int main(int count, char **arguments) {
    Options options = options_of(count, arguments);
    char *xml = read_file(options.description, "r", NULL);
    const char *experiment = strstr(xml, "<DefaultExperiment ");
    CHECK(experiment);
    double start_s = strtod(attribute_after(experiment, "startTime"), NULL);
    double stop_s = strtod(attribute_after(experiment, "stopTime"), NULL);
    double step_s = strtod(attribute_after(experiment, "stepSize"), NULL);
    long steps = options.steps ? options.steps : lround((stop_s - start_s) / step_s);
    long first = options.save || options.restore ? steps / 2 : 0;
    int output_count = outputs_of(xml, outputs);
    static Inputs inputs;
    if (options.inputs) open_inputs(&inputs, xml, options.inputs);

    Library library = open_library(options.library);
    fmi2Component c = initialized(&library, xml, &options, &inputs, start_s);
    if (options.restore) restore(&library, c, options.restore);
    for (long i = options.restore ? first : 0; i <= steps; i++) {
        if (i == first && options.save) save(&library, c, options.save);
        if (i >= first) {
            for (int k = 0; k < output_count; k++) take(&library, c, &outputs[k]);
        }
        if (i == steps) break;
        double time_s = start_s + step_s * (double)i;
        set_inputs(&inputs, &library, c, time_s);
        CHECK(library.DoStep(c, time_s, step_s, fmi2True) == fmi2OK);
    }
    CHECK(library.Terminate(c) == fmi2OK);
    library.FreeInstance(c);
    free(xml);
    free(inputs.text);
    printf("%ld communication points\n", steps - first + 1);
    for (int k = 0; k < output_count; k++)
        printf("%s %08lx%08lx %.17g\n", outputs[k].name, (unsigned long)(outputs[k].digest >> 32),
               (unsigned long)(outputs[k].digest & 0xffffffff), outputs[k].last);
    return 0;
}
