# SPDX-License-Identifier: MIT
"""What run.sh has measured, for tables and plot: lines "core model kind contestant measure value"."""

PEERS = ("eigen", "cmsis", "symforce")


class Results:
    def __init__(self, path):
        self.values, self.models, self.cores = {}, [], []
        with open(path, encoding="utf-8") as file:
            for line in file:
                core, model, kind, contestant, measure, value = line.split()
                self.values[core, model, kind, contestant, measure] = float(value)
                if (model, kind) not in self.models:
                    self.models.append((model, kind))
                if core not in self.cores:
                    self.cores.append(core)
        self.models.sort(key=lambda model: ("constant", "carried").index(model[1]))  # otherwise in their order

    def value(self, core, model, contestant, measure):
        """None where it has not been measured. Of Eigen's two variants the better one."""
        if contestant == "eigen":
            variants = [self.measured(core, model, variant, measure) for variant in ("eigen", "eigen_tuned")]
            return min((value for value in variants if value is not None), default=None)
        return self.measured(core, model, contestant, measure)

    def measured(self, core, model, contestant, measure):
        """A cheapest form that is the plain code is not measured again; memory is RAM and stack."""
        if measure == "memory":
            parts = [self.measured(core, model, contestant, part) for part in ("ram", "stack")]
            return None if None in parts else sum(parts)
        if contestant == "cheapest" and (core, *model, contestant, measure) not in self.values:
            contestant = "plain"
        return self.values.get((core, *model, contestant, measure))

    def best(self, core, model, peers, measure):
        values = [self.value(core, model, peer, measure) for peer in peers]
        return min((value for value in values if value is not None), default=None)

    def ratio(self, core, model, contestant, peers, measure):
        """Over the best one of the peers; None where one of both is missing or nothing."""
        own, other = self.value(core, model, contestant, measure), self.best(core, model, peers, measure)
        return own / other if own and other else None
