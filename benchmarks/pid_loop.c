/* What the compiled loop does for a PID law without sensing, failures and actuator, written by hand in C. */
#include <math.h>
#include <string.h>

static double opposing(double t, double p, double v, long *hint, const double *edges, const double *values, long sections,
                       const double *terms, long term_count, double mass) {
    while (*hint < sections - 1 && p >= edges[*hint + 1]) (*hint)++;
    while (*hint > 0 && p < edges[*hint]) (*hint)--;
    double total = 0.0;
    for (long i = 0; i < term_count; i++) {
        const double *row = terms + 7 * i;
        if (!(row[0] <= t && t < row[1])) continue;
        double value = row[2];
        if (row[3] != 0.0) value += row[3] * sin(row[4] * t + row[5]);
        if (row[6] >= 1.0) value *= v;
        if (row[6] >= 2.0) value *= v;
        total += value;
    }
    return mass * (values[2 * *hint] + values[2 * *hint + 1] * (p - edges[*hint]) + total);
}

static double rate(double v, double force, double against, const double *plant) {
    return (force - plant[1] - plant[2] * v - plant[3] * (v * v) - against) / plant[0];
}

long closed_loop(long steps, long per_sample, double dt, double *state, const double *breaks, const double *coefficients,
                 long pieces, long order, const double *edges, const double *values, long sections, const double *terms,
                 long term_count, const double *plant, const double *drive, double band, double nominal,
                 const double *gains, double *integral, double *acc, double *ride, long ride_count, double *log,
                 long columns, long rows, long log_every) {
    double p = state[0], v = state[1], u = state[2], force = state[3], period = dt * per_sample, early = 1e-9 * dt;
    long piece = 0, section = 0;
    for (long n = 0; n < steps; n++) {
        double t = n * dt, x = 0.0, xdot = 0.0, xddot = 0.0;
        while (piece < pieces - 1 && t >= breaks[piece + 1]) piece++;
        double h = t - breaks[piece];
        if (t >= breaks[pieces]) h = breaks[pieces] - breaks[piece];
        for (long i = order - 1; i >= 0; i--) {
            xddot = xddot * h + 2.0 * xdot;
            xdot = xdot * h + x;
            x = x * h + coefficients[piece * order + i];
        }
        if (t >= breaks[pieces]) xdot = xddot = 0.0;
        double e_p = p - x, e_v = v - xdot;
        acc[0] += 1.0;
        if (e_p < acc[1] || e_p > acc[2]) {
            if (acc[0] == 1.0 || fabs(e_p) > fmax(fabs(acc[1]), fabs(acc[2]))) acc[14] = t;
            if (e_p < acc[1]) acc[1] = e_p;
            if (e_p > acc[2]) acc[2] = e_p;
        }
        if (e_v < acc[3]) acc[3] = e_v;
        if (e_v > acc[4]) acc[4] = e_v;
        acc[5] += e_p * e_p;
        acc[6] += e_v * e_v;
        if (fabs(e_p) > band) acc[10] += 1.0;
        if (v < acc[13]) acc[13] = v;
        if (n % per_sample == 0) {
            *integral = period * (-p + x) + *integral;
            u = gains[2] * (-v + xdot) + gains[1] * *integral + gains[0] * (-p + x);
            if (!isfinite(u)) return 2;
            double wanted = nominal * u, speed = fabs(v), highest = drive[2] / (speed > 1e-3 ? speed : 1e-3);
            if (drive[0] < highest) highest = drive[0];
            force = wanted > -drive[1] ? wanted : -drive[1];
            if (force > highest) force = highest;
            acc[15] += 1.0;
            if (wanted >= highest * (1.0 - 1e-9) || wanted <= -drive[1] * (1.0 - 1e-9)) acc[9] += 1.0;
            if (u > acc[11]) acc[11] = u;
            if (u < acc[12]) acc[12] = u;
            if (acc[15] > 1.0) {
                double change = u - acc[18];
                if (change * acc[19] < 0.0) acc[16] += 1.0;
                acc[17] += fabs(change);
                acc[19] = change;
            }
            acc[18] = u;
        }
        if (n % log_every == 0 && n / log_every < rows) {
            double *row = log + n / log_every * columns;
            row[0] = t, row[1] = p, row[2] = v, row[3] = x, row[4] = xdot, row[5] = xddot, row[6] = u;
            row[7] = force / nominal, row[8] = *integral;
        }
        t += early;
        double half = 0.5 * dt, before = v, end = t + dt - 2.0 * early, p2, p3, p4, v1, v2, v3, v4;
        v1 = rate(v, force, opposing(t, p, v, &section, edges, values, sections, terms, term_count, plant[0]), plant);
        p2 = v + half * v1;
        v2 = rate(p2, force, opposing(t + half, p + half * v, p2, &section, edges, values, sections, terms, term_count,
                                      plant[0]), plant);
        p3 = v + half * v2;
        v3 = rate(p3, force, opposing(t + half, p + half * p2, p3, &section, edges, values, sections, terms, term_count,
                                      plant[0]), plant);
        p4 = v + dt * v3;
        v4 = rate(p4, force, opposing(end, p + dt * p3, p4, &section, edges, values, sections, terms, term_count,
                                      plant[0]), plant);
        double moved = dt / 6.0 * (v + 2.0 * p2 + 2.0 * p3 + p4);
        v += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        p += moved;
        double work = force * moved, push = force / nominal, a = (v - before) / dt;
        if (work > 0.0) acc[7] += work; else acc[8] -= work;
        if (ride[0] > 0.0) {
            double jerk = fabs(a - ride[1]) / dt;
            int exponent;
            double mantissa = frexp(jerk, &exponent);
            long place = 64 * (exponent + 20) + (long)(128.0 * mantissa) - 64;
            ride[2] += jerk * jerk;
            if (jerk > ride[3]) ride[3] = jerk;
            if (jerk == 0.0 || place < 0) place = 0;
            ride[31 + place < ride_count - 1 ? 31 + place : ride_count - 1] += 1.0;
        }
        ride[0] += 1.0;
        ride[1] = a;
        if (fabs(push) >= 1e-3) {
            if (push * ride[4] < 0.0) ride[5] += 1.0;
            ride[4] = push;
        }
        for (int i = 10; i < 31; i += 7) {
            double y = ride[i] * a + ride[i + 5];
            ride[i + 5] = ride[i + 1] * a - ride[i + 3] * y + ride[i + 6];
            ride[i + 6] = ride[i + 2] * a - ride[i + 4] * y;
            a = y;
        }
        ride[8] += a * a;
        if (!(fabs(p) < 1e9 && fabs(v) < 1e4)) return 2;
    }
    state[0] = p, state[1] = v, state[2] = u, state[3] = force;
    return 0;
}
