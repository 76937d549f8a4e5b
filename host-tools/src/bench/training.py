"""Trains the problem on standard input with scikit-learn and PyTorch, whichever are installed."""

import json
import sys
import time

runs = []
try:
    import numpy as np
except ImportError:
    print("[]")
    sys.exit(0)

problem = json.load(sys.stdin)
x, y, vx, vy = (
    np.asarray(problem[key], dtype=np.float32)
    for key in ("inputs", "targets", "held_out_inputs", "held_out_targets")
)
hidden, epochs, batch, rate = (problem[key] for key in ("hidden", "epochs", "batch", "rate"))


def run(name, epoch, loss):
    spent, points = 0.0, []
    for _ in range(epochs):
        begin = time.perf_counter()
        epoch()
        spent += time.perf_counter() - begin
        points.append((spent, float(loss())))
    runs.append({"name": name, "points": points})


try:
    from sklearn.neural_network import MLPRegressor

    model = MLPRegressor(hidden_layer_sizes=(hidden, hidden), activation="tanh", alpha=0.0, batch_size=batch, learning_rate_init=rate, random_state=1)
    run("scikit-learn", lambda: model.partial_fit(x, y), lambda: np.mean((model.predict(vx) - vy) ** 2))
except ImportError:
    pass

try:
    import torch

    torch.manual_seed(1)
    torch.set_num_threads(2)
    layers = (
        torch.nn.Linear(x.shape[1], hidden), torch.nn.Tanh(),
        torch.nn.Linear(hidden, hidden), torch.nn.Tanh(),
        torch.nn.Linear(hidden, y.shape[1]),
    )
    net = torch.nn.Sequential(*layers)
    method = torch.optim.Adam(net.parameters(), lr=rate)
    tx, ty, tvx, tvy = (torch.from_numpy(a) for a in (x, y, vx, vy))

    def epoch():
        order = torch.randperm(len(tx))
        for start in range(0, len(tx), batch):
            part = order[start:start + batch]
            method.zero_grad()
            torch.nn.functional.mse_loss(net(tx[part]), ty[part]).backward()
            method.step()

    def loss():
        with torch.no_grad():
            return torch.nn.functional.mse_loss(net(tvx), tvy)

    run("PyTorch", epoch, loss)
except (ImportError, ValueError):  # the latter where it wants libraries of a GPU that are not there
    pass

print(json.dumps(runs))
