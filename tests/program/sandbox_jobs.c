/* SPDX-License-Identifier: MIT */
/* Sandboxed jobs side by side, and the progress that they report. */
#include "app/base/sandbox.h"
#include "tests/oracle/check.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static char subject[] = "SCENE";

static bool say(int output, const char *text) {
    return sandbox_write(output, text, strlen(text));
}

static void run(const sandbox_job *job) {
    base_error error = { "" };
    void *block;
    size_t size;
    if (!sandbox_run(job, &block, &size, &error))
        fail_msg("%s", error.text);
    assert_memory_equal(block, "done", 4);
    munmap(block, size);
}

static double told[200];
static int told_times;

static void note(void *context, double done) {
    (void)context;
    assert_true(told_times < 200);
    told[told_times++] = done;
}

static bool work_in_steps(void *context, int output, base_error *error) {
    (void)context;
    (void)error;
    for (int i = 0; i < 100000; i++)
        sandbox_progress(i / 1e5);
    return say(output, "done");
}

/* Progress is reported a few times, rising; nothing is reported to a caller that does not ask, nor
 * without a child. */
static void the_work_tells_how_much_of_it_is_done(void **state) {
    (void)state;
    sandbox_job job = { .subject = subject, .work = work_in_steps };
    told_times = 0;
    run(&job);
    sandbox_progress(0.5);
    assert_int_equal(told_times, 0);
    job.progress = note;
    run(&job);
    assert_in_range(told_times, 20, 100);
    for (int i = 0; i < told_times; i++)
        assert_true(told[i] > (i ? told[i - 1] : 0) && told[i] <= 1);
}

static bool work_for_ever(void *context, int output, base_error *error) {
    (void)context;
    (void)output;
    (void)error;
    for (volatile int always = 1; always;)
        continue;
    return false;
}

static bool at_the_third_time(void *context) {
    return ++*(int *)context == 3;
}

static void a_cancelled_job_ends_at_once(void **state) {
    (void)state;
    int asked = 0;
    base_error error = { "" };
    void *block;
    size_t size;
    const sandbox_job job = {
        .subject = subject, .context = &asked, .work = work_for_ever, .cancelled = at_the_third_time
    };
    assert_false(sandbox_run(&job, &block, &size, &error));
    assert_string_equal(error.text, "SCENE: was cancelled");
}

typedef struct numbered {
    int number;
} numbered;

static bool write_part(void *context, int output, base_error *error) {
    const numbered *p = context;
    const char text[2] = { (char)('a' + p->number), 0 };
    return p->number == 3 ? base_fail(error, subject, "has no third part") : say(output, text);
}

static void jobs_run_side_by_side(void **state) {
    (void)state;
    numbered parts[4] = { { 0 }, { 1 }, { 2 }, { 3 } };
    sandbox_job jobs[4];
    void *blocks[4];
    size_t sizes[4];
    base_error error;
    for (int i = 0; i < 4; i++)
        jobs[i] = (sandbox_job) { .subject = subject, .context = &parts[i], .work = write_part };
    assert_true(sandbox_run_all(jobs, 3, blocks, sizes, &error));
    for (int i = 0; i < 3; i++) {
        assert_int_equal(sizes[i], 1);
        assert_int_equal(*(const char *)blocks[i], 'a' + i);
        munmap(blocks[i], sizes[i]);
    }
    assert_false(sandbox_run_all(jobs, 4, blocks, sizes, &error));
    assert_string_equal(error.text, "SCENE: has no third part");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_work_tells_how_much_of_it_is_done),
        cmocka_unit_test(a_cancelled_job_ends_at_once),
        cmocka_unit_test(jobs_run_side_by_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
