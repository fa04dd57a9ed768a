/* A small C master: the standard's own headers, the system's loader, and a description read with strstr. */
#ifndef HELIOTORQUE_TESTS_FMU_H
#define HELIOTORQUE_TESTS_FMU_H
#define _GNU_SOURCE
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#define FUNCTIONS(X)                                                                                           \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) X(SetupExperiment)     \
    X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger)        \
    X(GetBoolean) X(GetString) X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) X(GetFMUstate)              \
    X(SetFMUstate) X(FreeFMUstate) X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate)       \
    X(GetDirectionalDerivative) X(SetRealInputDerivatives) X(GetRealOutputDerivatives) X(DoStep) X(CancelStep) \
    X(GetStatus) X(GetRealStatus) X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus)

typedef int describe_function(const char *model, const char *file, const char *setup, void *context,
                              void (*receive)(void *context, int kind, const char *text, size_t length));

typedef struct {
#define FIELD(name) fmi2##name##TYPE *name;
    FUNCTIONS(FIELD)
#undef FIELD
    describe_function *describe;
    void *handle;
} Library;

#define CHECK(condition)                                                                       \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);            \
            exit(1);                                                                           \
        }                                                                                      \
    } while (0)

static inline void *symbol_of(void *handle, const char *name) {
#ifdef _WIN32
    return (void *)GetProcAddress(handle, name);
#else
    return dlsym(handle, name);
#endif
}

static inline Library open_library(const char *path) {
#ifdef _WIN32
    void *handle = LoadLibraryA(path);
    if (!handle) fprintf(stderr, "%s: LoadLibrary failed with %lu\n", path, GetLastError());
#else
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle) fprintf(stderr, "%s\n", dlerror());
#endif
    if (!handle) exit(1);
    Library library;
    library.handle = handle;
#define BIND(name)                                                      \
    *(void **)&library.name = symbol_of(handle, "fmi2" #name);          \
    if (!library.name) {                                                \
        fprintf(stderr, "%s: no symbol fmi2%s\n", path, #name);         \
        exit(1);                                                        \
    }
    FUNCTIONS(BIND)
#undef BIND
    *(void **)&library.describe = symbol_of(handle, "fmi_export_describe");
    CHECK(library.describe);
    return library;
}

static inline void keep_text(void *context, int kind, const char *text, size_t length) {
    if (kind != 0) return;
    char *copy = malloc(length + 1);
    CHECK(copy);
    memcpy(copy, text, length);
    copy[length] = 0;
    free(*(char **)context);
    *(char **)context = copy;
}

/* The XML of a model with its compiled-in setup; the caller frees it. */
/* Not inlined: gcc then takes what the callback stores for the address of the local it is stored in. */
static __attribute__((noinline, unused)) char *description_of(const Library *library, const char *model) {
    char *xml = NULL;
    CHECK(library->describe(model, NULL, NULL, &xml, keep_text) == 0);
    CHECK(xml);
    return xml;
}

/* The value of the first `attribute="..."` after `from`. */
static inline const char *attribute_after(const char *from, const char *attribute) {
    static _Thread_local char value[256];
    char key[64];
    snprintf(key, sizeof key, " %s=\"", attribute);
    const char *begin = strstr(from, key);
    CHECK(begin);
    begin += strlen(key);
    size_t length = strcspn(begin, "\"");
    CHECK(length < sizeof value);
    memcpy(value, begin, length);
    value[length] = 0;
    return value;
}

static inline fmi2ValueReference reference_of(const char *xml, const char *name) {
    char key[256];
    snprintf(key, sizeof key, " name=\"%s\"", name);
    const char *at = strstr(xml, key);
    if (!at) {
        fprintf(stderr, "no variable %s\n", name);
        exit(1);
    }
    return (fmi2ValueReference)strtoul(attribute_after(at, "valueReference"), NULL, 10);
}

static _Thread_local int logged_messages;

static inline void quiet_logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                                fmi2String category, fmi2String message, ...) {
    (void)environment, (void)instance, (void)status, (void)category;
    char text[2048];
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    logged_messages++;
    if (getenv("SHOW_LOG")) fprintf(stderr, "%s\n", text);
}

/* Instantiates with callbacks that end right after the call, as the standard allows. */
static inline fmi2Component instantiate(const Library *library, const char *xml, fmi2String location) {
    char guid[256];
    snprintf(guid, sizeof guid, "%s", attribute_after(xml, "guid"));
    fmi2CallbackFunctions callbacks = {quiet_logger, NULL, NULL, NULL, NULL};
    fmi2Component component =
        library->Instantiate("instance", fmi2CoSimulation, guid, location, &callbacks, fmi2False, fmi2False);
    memset(&callbacks, 0xAA, sizeof callbacks);
    return component;
}

static inline fmi2Component start(const Library *library, const char *xml) {
    fmi2Component component = instantiate(library, xml, NULL);
    CHECK(component);
    CHECK(library->SetupExperiment(component, fmi2False, 0, 0, fmi2False, 0) == fmi2OK);
    CHECK(library->EnterInitializationMode(component) == fmi2OK);
    return component;
}
#endif
