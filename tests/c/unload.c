/* Unloading unloads: as importers do, every simulation unpacks the library anew, loads it, runs, frees and unloads.
 *
 * usage: unload libheliotorque libprobe [simulations]
 *
 * After each simulation the copy must be gone from the address space; after all of them the heap must hold what it held. */
#include "fmu.h"

#include <malloc.h>
#include <sys/stat.h>
#include <unistd.h>

/* The value of an enumeration item of this name. */
static int item_of(const char *xml, const char *name) {
    char key[256];
    snprintf(key, sizeof key, "<Item name=\"%s\"", name);
    const char *at = strstr(xml, key);
    CHECK(at);
    return atoi(attribute_after(at, "value"));
}

static void copy_file(const char *from, const char *to) {
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
    CHECK(in && out);
    static char block[1 << 16];
    size_t count;
    while ((count = fread(block, 1, sizeof block, in)) > 0) CHECK(fwrite(block, 1, count, out) == count);
    CHECK(fclose(in) == 0 && fclose(out) == 0);
}

static int is_mapped(const char *path) {
    FILE *maps = fopen("/proc/self/maps", "r");
    CHECK(maps);
    static char line[4096];
    int found = 0;
    while (fgets(line, sizeof line, maps)) found |= strstr(line, path) != NULL;
    fclose(maps);
    return found;
}

/* What this process holds beside mapped files, in kB. */
static long anonymous_kb(void) {
    FILE *rollup = fopen("/proc/self/smaps_rollup", "r");
    CHECK(rollup);
    static char line[256];
    long kb = -1;
    while (fgets(line, sizeof line, rollup)) {
        if (strncmp(line, "Anonymous:", 10) == 0) kb = atol(line + 10);
    }
    fclose(rollup);
    CHECK(kb >= 0);
    return kb;
}

/* Steps, a saved state, its bytes, and for the panicking model one panic after another. */
static void simulate(const Library *library, const char *xml, const char *model, fmi2Component c) {
    int panicking = strcmp(model, "Panicking") == 0;
    if (strcmp(model, "MomentumPlant") == 0) {
        /* About the Earth, whose air (NRLMSISE-00) and magnetic field (IGRF) come from tables. */
        const fmi2ValueReference choices[] = {
            reference_of(xml, "orbit.center"), reference_of(xml, "atmosphere.method"), reference_of(xml, "magneticField.method")};
        const fmi2ValueReference circle[] = {reference_of(xml, "orbit.semiMajorAxis"), reference_of(xml, "orbit.eccentricity")};
        CHECK(library->SetInteger(c, choices, 3, (const fmi2Integer[]){4, 2, item_of(xml, "igrf14")}) == fmi2OK);
        CHECK(library->SetReal(c, circle, 2, (const fmi2Real[]){6.9e6, 0.0}) == fmi2OK);
    }
    CHECK(library->ExitInitializationMode(c) == fmi2OK);
    for (int i = 0; i < 3; i++) CHECK(library->DoStep(c, 60.0 * i, 60.0, fmi2True) == fmi2OK);
    fmi2FMUstate state = NULL;
    size_t size = 0;
    CHECK(library->GetFMUstate(c, &state) == fmi2OK);
    CHECK(library->SerializedFMUstateSize(c, state, &size) == fmi2OK);
    fmi2Byte *bytes = malloc(size);
    CHECK(bytes && library->SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    CHECK(library->FreeFMUstate(c, &state) == fmi2OK);
    free(bytes);
    if (panicking) {
        const char *faults[] = {"step", "stepPayload", "stepPayloadDrop", "stepIndex"};
        for (int i = 0; i < 4; i++) {
            fmi2Component failing = start(library, xml);
            fmi2ValueReference fault = reference_of(xml, "fault");
            fmi2Integer item = item_of(xml, faults[i]);
            CHECK(library->ExitInitializationMode(failing) == fmi2OK);
            CHECK(library->SetInteger(failing, &fault, 1, &item) == fmi2OK);
            CHECK(library->DoStep(failing, 0.0, 1.0, fmi2True) == fmi2Error);
            library->FreeInstance(failing);
        }
    }
    CHECK(library->Terminate(c) == fmi2OK);
}

/* Instances that nobody frees; kept, so that a leak checker can distinguish them from what is lost. */
fmi2Component left_open[32];
static int left_count;

static void simulation(const char *path, const char *model, int number, int leave_open) {
    char copy[256];
    snprintf(copy, sizeof copy, "./simulation-%d-%s.so", number, model);
    copy_file(path, copy);
    Library library = open_library(copy);
    char *xml = description_of(&library, model);
    fmi2Component c = start(&library, xml);
    simulate(&library, xml, model, c);
    if (leave_open) {
        CHECK(left_count < 32);
        left_open[left_count++] = c;
    } else {
        library.FreeInstance(c);
    }
    free(xml);
    CHECK(is_mapped(copy + 1));
    CHECK(dlclose(library.handle) == 0);
    if (is_mapped(copy + 1)) {
        fprintf(stderr, "%s: still mapped after simulation %d of %s\n", copy, number, model);
        exit(1);
    }
    CHECK(unlink(copy) == 0);
}

int main(int count, char **arguments) {
    if (count < 3) {
        fprintf(stderr, "usage: %s libheliotorque libprobe [simulations]\n", arguments[0]);
        return 2;
    }
    /* Backtraces must not keep a copy of the library either. */
    setenv("RUST_BACKTRACE", "1", 1);
    int simulations = count > 3 ? atoi(arguments[3]) : 1000;
    const struct { const char *library, *model; } rows[] = {
        {arguments[1], "MomentumPlant"}, {arguments[1], "SpinPlant"}, {arguments[1], "DisturbanceTorque"},
        {arguments[1], "Guidance"},
        {arguments[2], "AllTypes"},      {arguments[2], "Panicking"},
    };
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        /* Loader and heap reach their size in the first simulations. */
        int first = simulations / 10 + 2;
        for (int i = 0; i < first; i++) simulation(rows[row].library, rows[row].model, i, 0);
        size_t bytes_before = mallinfo2().uordblks;
        long before_kb = anonymous_kb();
        for (int i = 0; i < simulations; i++) simulation(rows[row].library, rows[row].model, first + i, 0);
        long grown = (long)mallinfo2().uordblks - (long)bytes_before;
        long grown_kb = anonymous_kb() - before_kb;
        printf("%s: %d simulations, heap %+ld bytes, memory %+ld kB\n", rows[row].model, simulations, grown, grown_kb);
        /* malloc counts the blocks it keeps for reuse; the smallest block lost in each of a thousand simulations is 24 kB. */
        CHECK(grown < 128 * 1024);
        /* A checker's own pages grow; a copy of the library in each simulation is megabytes. */
        CHECK(simulations < 100 || grown_kb <= 1024);
    }
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        size_t bytes_before = mallinfo2().uordblks;
        for (int i = 0; i < 3; i++) simulation(rows[row].library, rows[row].model, i, 1);
        long each = ((long)mallinfo2().uordblks - (long)bytes_before) / 3;
        printf("%s: an instance left open keeps %ld bytes\n", rows[row].model, each);
        CHECK(each < 1 << 20);
    }
    puts("C client: every simulation unloaded its library");
    return 0;
}
