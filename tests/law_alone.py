"""A law's compiled control step, given what was measured; without plant and loop, which take longest to compile."""
# ruff: noqa: F821

ENTRIES = ("answers",)

# --- kernel ---


def answers(samples, parameters, scalars, neurons, neuron_data, commands, states):
    """Command and states of one number after each sample; a row of samples holds the law's measurements."""
    for i in range(samples.shape[0]):
        row = samples[i]
        commands[i] = control_step(row[0], row[1], row[2], row[3], row[4], row[5], row[6], parameters, scalars, neurons,
                                   neuron_data)
        for k in range(len(scalars)):  # by itself: an array put into a row takes numba two seconds more
            states[i, k] = scalars[k]
