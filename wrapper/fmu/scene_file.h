/* scene_file.h - the tables of one scene, as `planemotion export-fmu` leaves them in an FMU. */
#ifndef PM_SCENE_FILE_H
#define PM_SCENE_FILE_H

#include <stdint.h>

#define PM_GUID_LENGTH 36

/* `table`, `constant`: as planemotion.h says; `value`: the parameters, SI, at first as the scene has them; `program`: the
 * programs of the outputs. */
typedef struct pm_scene_file {
    char guid[PM_GUID_LENGTH + 1];
    int64_t ntable, nconstant, nparam, noutput;
    int32_t *table, *program;
    double *constant, *value;
} pm_scene_file;

/* Reads resources/scene.bin of the FMU whose resources are at `uri`.  0, or -1 where it cannot be read. */
int pm_scene_file_read(const char *uri, pm_scene_file *scene);
void pm_scene_file_free(pm_scene_file *scene);

#endif
