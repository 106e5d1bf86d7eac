/* `tar -xf ARCHIVE -C FOLDER`, by which ecos unpacks FMUs on Windows: Wine has no tar. %TTB_PYTHON% does it. */
#include <process.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    if (argc != 5) return 2;
    return (int)_spawnl(_P_WAIT, getenv("TTB_PYTHON"), "python", "-m", "zipfile", "-e", argv[2], argv[4], NULL);
}
