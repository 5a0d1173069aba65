/* SPDX-License-Identifier: MIT */
/* lanterns.c - a window with moving lanterns, lit by lampion.glsl: nothing of lampion is linked.
 *
 *     cc lanterns.c $(pkg-config --cflags --libs glfw3 epoxy) -lm -o lanterns
 *     ./lanterns $(pkg-config --variable=glsl lampion)/lampion.glsl lanterns.frag
 *
 * With two more words, a number of frames and FILE.ppm, it ends after so many frames, the last of
 * them in the file. */
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { LIGHTS = 6, WIDTH = 960, HEIGHT = 540 };

/* Defines what lampion.glsl needs: bands, window, and where the lights are. */
static const char head[] = "#version 450 core\n"
                           "#define LMP_BANDS 8\n"
                           "#define LMP_WINDOW LMP_WINDOW_HANNING\n"
                           "uniform vec4 lights[12];\n"
                           "#define LMP_LIGHT_COUNT 6\n"
                           "#define LMP_LIGHT_SPHERE(i) lights[2 * (i)]\n"
                           "#define LMP_LIGHT_RADIANCE(i) lights[2 * (i) + 1].rgb\n";

/* A single triangle that covers the window. */
static const char vertex_shader[] =
    "#version 450 core\n"
    "uniform float aspect;\n"
    "out vec2 at;\n"
    "void main() {\n"
    "    vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0;\n"
    "    at = corner * vec2(aspect, 1.0);\n"
    "    gl_Position = vec4(corner, 0.0, 1.0);\n"
    "}\n";

static void stop(const char *what, const char *why) {
    fprintf(stderr, "lanterns: %s: %s\n", what, why);
    exit(1);
}

static char *read_text(const char *path) {
    FILE *const file = fopen(path, "rb");
    char *const text = calloc(1, 1 << 20);
    if (!file || !text || fread(text, 1, (1 << 20) - 1, file) == 0)
        stop(path, "cannot be read");
    fclose(file);
    return text;
}

static void add_shader(GLuint program, GLenum kind, int count, const char *const *texts) {
    char log[2000];
    GLint ok;
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, count, texts, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!ok)
        stop("shader", log);
    glAttachShader(program, shader);
}

static GLuint build_program(const char *lampion, const char *scene) {
    const char *const vertex[] = { vertex_shader }, *const fragment[] = { head, lampion, scene };
    const GLuint program = glCreateProgram();
    add_shader(program, GL_VERTEX_SHADER, 1, vertex);
    add_shader(program, GL_FRAGMENT_SHADER, 3, fragment);
    glLinkProgram(program);
    glUseProgram(program);
    return program;
}

/* Moves lanterns on a ring that bobs: each has its center and radius, then its radiance. */
static void move_lights(float seconds, float lights[LIGHTS][2][4]) {
    for (int i = 0; i < LIGHTS; i++) {
        const float angle = 0.5f * seconds + 6.2832f * (float)i / LIGHTS;
        const float warm = (float)i / (LIGHTS - 1), radius = 0.14f + 0.08f * warm;
        const float values[2][4] = {
            { 3.1f * cosf(angle), 1.5f + 0.4f * sinf(3 * angle), 0.2f + 1.8f * sinf(angle),
              radius },
            { 16, 4 + 8 * warm, 12 - 10 * warm, 0 },
        };
        for (int k = 0; k < 8; k++)
            lights[i][k / 4][k % 4] = values[k / 4][k % 4];
    }
}

static void write_image(const char *path, int width, int height) {
    unsigned char *const rgb = malloc(3 * (size_t)width * (size_t)height);
    FILE *const file = fopen(path, "wb");
    if (!rgb || !file)
        stop(path, "cannot be written");
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    fprintf(file, "P6 %d %d 255\n", width, height);
    for (int y = height - 1; y >= 0; y--)
        fwrite(rgb + 3 * width * y, 3, (size_t)width, file);
    fclose(file);
    free(rgb);
}

int main(int argc, char **argv) {
    const int frames = argc == 5 ? atoi(argv[3]) : 0;
    if (argc != 3 && frames <= 0)
        stop("usage", "lanterns lampion.glsl lanterns.frag [FRAMES FILE.ppm]");
    if (!glfwInit())
        stop("GLFW", "there is no display");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow *const window = glfwCreateWindow(WIDTH, HEIGHT, "lanterns", NULL, NULL);
    if (!window)
        stop("GLFW", "there is no OpenGL 4.5");
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);

    const GLuint program = build_program(read_text(argv[1]), read_text(argv[2]));
    const GLint lights_at = glGetUniformLocation(program, "lights");
    const GLint aspect_at = glGetUniformLocation(program, "aspect");
    GLuint no_attributes;
    glGenVertexArrays(1, &no_attributes);
    glBindVertexArray(no_attributes);

    for (int frame = 0; !glfwWindowShouldClose(window); frame++) {
        int width, height;
        float lights[LIGHTS][2][4];
        move_lights(frames ? (float)frame / 60 : (float)glfwGetTime(), lights);
        glfwGetFramebufferSize(window, &width, &height);
        glViewport(0, 0, width, height);
        glUniform1f(aspect_at, (float)width / (float)(height ? height : 1));
        glUniform4fv(lights_at, 2 * LIGHTS, &lights[0][0][0]);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        if (frame + 1 == frames) {
            write_image(argv[4], width, height);
            break;
        }
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    glfwTerminate();
    return 0;
}
