/* scene_file.c - reads the file scene.bin: the mark, the GUID, four counts (int64), then the table (int32), the constants and
 * parameters (double) and the programs of the outputs (int32), all in the order of bytes of this machine. */
#include "scene_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MARK "planemotion FMU 1\n"
#define LONGEST_PATH 4096
/* Numbers of one array: more is a damaged file. */
#define MOST_NUMBERS (1 << 28)

static int hexadecimal(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/* The path of file:///a%20b, file:/a%20b or /a b. */
static int path_of(const char *uri, char *path, size_t room)
{
    size_t n = 0;
    if (!strncmp(uri, "file:", 5)) {
        uri += 5;
        if (!strncmp(uri, "//", 2)) {
            uri += 2;
            while (*uri && *uri != '/') uri++; /* the host */
        }
    }
    for (; *uri; uri++) {
        if (n + 1 >= room) return -1;
        if (*uri == '%' && hexadecimal(uri[1]) >= 0 && hexadecimal(uri[2]) >= 0) {
            path[n++] = (char)(16 * hexadecimal(uri[1]) + hexadecimal(uri[2]));
            uri += 2;
        } else {
            path[n++] = *uri;
        }
    }
    path[n] = 0;
    return 0;
}

/* An array of n numbers of a size, from the file; NULL if it is not there. */
static void *numbers(FILE *file, int64_t n, size_t size)
{
    void *array;
    if (n < 0 || n > MOST_NUMBERS) return NULL;
    array = malloc((size_t)(n + 1) * size);
    if (array && fread(array, size, (size_t)n, file) != (size_t)n) {
        free(array);
        return NULL;
    }
    return array;
}

static int read_all(FILE *file, pm_scene_file *s)
{
    char mark[sizeof MARK] = "";
    int64_t count[4];
    if (fread(mark, 1, sizeof mark - 1, file) != sizeof mark - 1 || strcmp(mark, MARK)) return -1;
    if (fread(s->guid, 1, PM_GUID_LENGTH, file) != PM_GUID_LENGTH) return -1;
    if (fread(count, sizeof *count, 4, file) != 4) return -1;
    s->ntable = count[0];
    s->nconstant = count[1];
    s->nparam = count[2];
    s->noutput = count[3];
    s->table = numbers(file, s->ntable, sizeof *s->table);
    s->constant = numbers(file, s->nconstant, sizeof *s->constant);
    s->value = numbers(file, s->nparam, sizeof *s->value);
    s->program = numbers(file, s->noutput, sizeof *s->program);
    return s->table && s->constant && s->value && s->program ? 0 : -1;
}

int pm_scene_file_read(const char *uri, pm_scene_file *scene)
{
    char path[LONGEST_PATH];
    size_t n;
    FILE *file;
    int failed;
    memset(scene, 0, sizeof *scene);
    if (!uri || path_of(uri, path, sizeof path)) return -1;
    n = strlen(path);
    if (n + sizeof "/scene.bin" > sizeof path) return -1;
    memcpy(path + n, "/scene.bin", sizeof "/scene.bin");
    file = fopen(path, "rb");
    if (!file) return -1;
    failed = read_all(file, scene);
    fclose(file);
    if (failed) pm_scene_file_free(scene);
    return failed;
}

void pm_scene_file_free(pm_scene_file *scene)
{
    free(scene->table);
    free(scene->constant);
    free(scene->value);
    free(scene->program);
    memset(scene, 0, sizeof *scene);
}
