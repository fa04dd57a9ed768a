/* Windows: keeps a file open to read, with a share mode (1 read, 2 write, 4 delete), until a line comes; then shows what it reads. */
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

int wmain(int count, wchar_t **arguments) {
    char text[4096], line[8];
    DWORD got = 0;
    if (count != 3) return 2;
    HANDLE file = CreateFileW(arguments[1], GENERIC_READ, (DWORD)_wtoi(arguments[2]), NULL, OPEN_EXISTING, 0, NULL);
    if (file == INVALID_HANDLE_VALUE) return 1;
    puts("held");
    fflush(stdout);
    if (!fgets(line, sizeof line, stdin)) return 1;
    if (!ReadFile(file, text, sizeof text, &got, NULL)) return 1;
    fwrite(text, 1, got, stdout);
    return 0;
}
