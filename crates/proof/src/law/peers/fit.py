"""Fits peers of a law to a residual series: fit.py JOB.json RESULT.json.

A job holds windows of the recordings to fit (values of the variables, what acted, its standard deviation) and windows of
the recording left out without what acted there. A result holds, for each peer, what it predicts in these windows, its
formulas as nested lists, how many parts they have, and processor time. Every choice among settings is made on one
recording of the fit after the other, left out of the rest.
"""

import json
import os
import re
import sys
import time
import warnings

# Processor time of one core, and no fight for the cores with what else runs.
for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[threads] = "1"

import gplearn
import numpy as np
import pysindy
import sklearn
from gplearn.functions import _function_map, _Function, make_function
from gplearn.genetic import SymbolicRegressor
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
from sklearn.neural_network import MLPRegressor

SEED = 0
ANGLES = ["phi", "heading"]
# Columns of a library whose coefficient is below this share of the target's norm go, columns being of norm one.
THRESHOLDS = [0.02, 0.05, 0.1, 0.2, 0.4]
# Widths of a smoothed sign, in the variable's rms.
SMOOTH = 0.1
PENALTIES = [0.1, 10.0, 1000.0]
# Windows on which the lengths of a Gaussian process are chosen; all windows are in its answer.
MOST_FOR_LENGTHS = 300


class Data:
    """Windows to fit and windows to predict."""

    def __init__(self, job):
        self.names = job["variables"]
        windows = job["fit"]
        self.x = np.array([w["values"] for w in windows])
        self.y = np.array([w["size"] for w in windows])
        self.sigma = np.array([w["sigma"] for w in windows])
        self.of = np.array([w["recording"] for w in windows])
        self.left_out = self.within(self.x, np.array(job["left_out"]))
        # Relative weights of mean one.
        self.weight = self.sigma**-2 / np.mean(self.sigma**-2)

    def within(self, seen, x):
        """Windows whose variables are held within the range seen, as those of a law are; angles only repeat."""
        low, high = seen.min(axis=0), seen.max(axis=0)
        is_angle = np.array([name in ANGLES for name in self.names])
        return np.where(is_angle, x, np.clip(x, low, high))

    def folds(self):
        """Each recording of the fit against the others."""
        for name in sorted(set(self.of)):
            yield self.of != name, self.of == name

    def best(self, settings, fit):
        """The setting whose fits err least on recordings left out of them; `fit(x, y, weight, setting)` predicts."""

        def error(setting):
            total = 0.0
            for rest, out in self.folds():
                predict = fit(self.x[rest], self.y[rest], self.weight[rest], setting)
                predicted = predict(self.within(self.x[rest], self.x[out]))
                total += np.sum(self.weight[out] * (self.y[out] - predicted) ** 2)
            return total if np.isfinite(total) else np.inf

        return min(settings, key=error)


def product(factors):
    """A product as nested lists."""
    out = factors[0]
    for factor in factors[1:]:
        out = ["mul", out, factor]
    return out


def total(terms):
    """A sum as nested lists."""
    out = terms[0] if terms else 0.0
    for term in terms[1:]:
        out = ["add", out, term]
    return out


def column(name):
    """A column of a library by its name there, `x0 x1`, `x0^2`, `sin(1 x0)`, `tanh(x0/w)`, `abs(x0) x0`, as nested lists."""
    if harmonic := re.fullmatch(r"(sin|cos)\(\d (x\d+)\)", name):
        return [harmonic[1], harmonic[2]]
    if sign := re.fullmatch(r"tanh\((x\d+)/w\)", name):
        # The width is a number with the unit of the variable.
        return ["tanh", ["div", sign[1], 1.0]]
    if square := re.fullmatch(r"abs\((x\d+)\) (x\d+)", name):
        return ["mul", ["abs", square[1]], square[2]]
    powers = [re.fullmatch(r"(x\d+)(?:\^(\d))?", part).groups() for part in name.split(" ")]
    return product([base for base, power in powers for _ in range(int(power or 1))])


def plain_library(_data):
    """As the package's own pages set one up: polynomials and harmonics of every variable."""
    return pysindy.PolynomialLibrary(degree=2) + pysindy.FourierLibrary(n_frequencies=1)


def closed_library(data):
    """Made by hand such that units close: harmonics of angles alone, smoothed signs of a width of their own."""
    amounts = [i for i, name in enumerate(data.names) if name not in ANGLES]
    angles = [i for i, name in enumerate(data.names) if name in ANGLES]
    scale = np.sqrt(np.mean(data.x**2, axis=0)) * SMOOTH + 1e-9
    libraries, inputs = [pysindy.PolynomialLibrary(degree=2)], [amounts]
    for i in amounts:
        sign = pysindy.CustomLibrary(
            library_functions=[lambda x, s=scale[i]: np.tanh(x / s), lambda x: np.abs(x) * x],
            function_names=[lambda x: f"tanh({x}/w)", lambda x: f"abs({x}) {x}"],
        )
        libraries.append(sign)
        inputs.append([i])
    for i in angles:
        harmonics = [
            (lambda k, of, name: (lambda x: of(k * x), lambda x: f"{name}({k} {x})"))(k, of, name)
            for k in (1, 2, 4)
            for of, name in ((np.sin, "sin"), (np.cos, "cos"))
        ]
        libraries.append(
            pysindy.CustomLibrary(
                library_functions=[f for f, _ in harmonics], function_names=[n for _, n in harmonics]
            )
        )
        inputs.append([i])
    return pysindy.GeneralizedLibrary(libraries, inputs_per_library=inputs)


def sindy(make):
    """Sequentially thresholded least squares of PySINDy on one of the libraries."""

    def peer(data):
        library = make(data)
        library.fit(data.x)
        names = library.get_feature_names([f"x{i}" for i in range(data.x.shape[1])])

        def columns(x):
            # What grows out of the range of numbers has no place in a sum.
            return np.nan_to_num(np.asarray(library.transform(x)))

        def fitted(x, y, weight, threshold):
            root = np.sqrt(weight)[:, None]
            a, b = columns(x) * root, y[:, None] * root
            optimizer = pysindy.STLSQ(
                threshold=threshold * np.linalg.norm(b), alpha=1e-3, max_iter=20, normalize_columns=True
            )
            optimizer.fit(a, b)
            return np.ravel(optimizer.coef_)

        def fit(x, y, weight, threshold):
            c = fitted(x, y, weight, threshold)
            return lambda x: columns(x) @ c

        threshold = data.best(THRESHOLDS, fit)
        c = fitted(data.x, data.y, data.weight, threshold)
        terms = [(value, name) for value, name in zip(c, names) if value != 0.0]
        # Every column has a coefficient of its own.
        tree = total([1.0 if name == "1" else ["mul", 1.0, column(name)] for _, name in terms])
        text = " + ".join(f"{value:.3g} {name}" for value, name in terms)
        return columns(data.left_out) @ c, [tree], len(terms), text

    return peer


def program_tree(program):
    """A program of gplearn, written down in prefix order, as nested lists."""
    rest = iter(program)

    def read():
        node = next(rest)
        if isinstance(node, _Function):
            return [node.name] + [read() for _ in range(node.arity)]
        return f"x{node}" if isinstance(node, (int, np.integer)) else float(node)

    return read()


def symbolic(data):
    """Symbolic regression by genetic programming, gplearn."""
    tanh = make_function(function=np.tanh, name="tanh", arity=1)
    functions = ["add", "sub", "mul", "div", "sqrt", "log", "abs", "sin", "cos", tanh]
    assert all(f in _function_map for f in functions[:-1])
    strength = np.average(data.y**2, weights=data.weight)
    model = SymbolicRegressor(
        population_size=1000,
        generations=30,
        function_set=functions,
        const_range=(-5.0, 5.0),
        metric="mse",
        parsimony_coefficient=1e-3 * strength,
        random_state=SEED,
    )
    model.fit(data.x, data.y, sample_weight=data.weight)
    best = model._program
    return model.predict(data.left_out), [program_tree(best.program)], len(best.program), str(best)


def black_box(data, x):
    """Variables as a black box takes them: angles as their cosines and sines, the rest as it is."""
    columns = []
    for i, name in enumerate(data.names):
        columns.extend([np.cos(x[:, i]), np.sin(x[:, i])] if name in ANGLES else [x[:, i]])
    return np.stack(columns, axis=1)


def scaled(data, x):
    """Of mean zero and deviation one in the windows to fit; returns how any windows are brought there."""
    z = black_box(data, x)
    mean, deviation = z.mean(axis=0), z.std(axis=0) + 1e-9
    return lambda x: (black_box(data, x) - mean) / deviation


def network(data):
    """A network of two layers, scikit-learn."""

    def fit(x, y, weight, penalty):
        to = scaled(data, x)
        size = np.sqrt(np.average(y**2, weights=weight)) + 1e-12
        model = MLPRegressor(
            hidden_layer_sizes=(32, 32),
            activation="tanh",
            solver="lbfgs",
            alpha=penalty,
            max_iter=300,
            random_state=SEED,
        )
        model.fit(to(x), y / size, sample_weight=weight)
        return lambda x: size * model.predict(to(x))

    penalty = data.best(PENALTIES, fit)
    return fit(data.x, data.y, data.weight, penalty)(data.left_out), None, None, None


def gaussian_process(data):
    """A Gaussian process with a length for every variable, scikit-learn; the deviation of each window is known."""
    to = scaled(data, data.x)
    x, size = to(data.x), np.sqrt(np.average(data.y**2, weights=data.weight)) + 1e-12
    y, noise = data.y / size, (data.sigma / size) ** 2
    kernel = ConstantKernel(1.0) * RBF(np.full(x.shape[1], 3.0), (0.1, 1e4)) + WhiteKernel(0.1, (1e-6, 10.0))
    some = np.unique(np.linspace(0, len(y) - 1, MOST_FOR_LENGTHS).astype(int))
    lengths = GaussianProcessRegressor(kernel, alpha=noise[some]).fit(x[some], y[some])
    model = GaussianProcessRegressor(lengths.kernel_, alpha=noise, optimizer=None).fit(x, y)
    return size * model.predict(to(data.left_out)), None, None, None


PEERS = {
    "PySINDy, plain library": sindy(plain_library),
    "PySINDy, library by hand": sindy(closed_library),
    "gplearn": symbolic,
    "network": network,
    "Gaussian process": gaussian_process,
}


def main():
    with open(sys.argv[1]) as file:
        data = Data(json.load(file))
    warnings.simplefilter("ignore", ConvergenceWarning)
    warnings.simplefilter("ignore", UserWarning)
    np.seterr(all="ignore")
    out = []
    for name, peer in PEERS.items():
        began = time.process_time()
        predicted, trees, parts, text = peer(data)
        out.append(
            {
                "name": name,
                "predicted": [float(v) if np.isfinite(v) else 0.0 for v in predicted],
                "trees": trees,
                "parts": parts,
                "text": text,
                "seconds": time.process_time() - began,
            }
        )
    versions = {m.__name__: m.__version__ for m in (pysindy, gplearn, sklearn, np)}
    with open(sys.argv[2], "w") as file:
        json.dump({"peers": out, "versions": versions}, file)


if __name__ == "__main__":
    main()
