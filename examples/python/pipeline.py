"""spincat beside other classifiers of scikit-learn, over a folder with one folder of objects a category.

    python3 pipeline.py DATASET [SETTING=VALUE...]

A grid search over two of spincat's settings, and a pipeline in which scikit-learn's own classifier sees spincat's
features. Both are measured by the same splits. Settings are of the features, as image_width=16.
"""

from __future__ import annotations

import functools
import pathlib
import sys

import numpy as np
from sklearn.linear_model import LogisticRegression  # type: ignore[import]
from sklearn.model_selection import GridSearchCV, cross_val_score  # type: ignore[import]
from sklearn.pipeline import make_pipeline  # type: ignore[import]
from sklearn.preprocessing import FunctionTransformer  # type: ignore[import]

import spincat


def main(dataset: str, *settings: str) -> None:
    chosen = dict(setting.split("=") for setting in settings)
    files = sorted(file for file in pathlib.Path(dataset).glob("*/*") if file.is_file())
    labels = [file.parent.name for file in files]
    splits = spincat.Splits(3, test_share=0.25)

    classifier = spincat.Classifier(background=0, copies=0, **chosen)  # type: ignore[arg-type]
    search = GridSearchCV(classifier, {"c": [1, 10], "dimensions": [0, 50]}, cv=splits).fit(files, labels)
    print(f"spincat: {search.best_score_:.3f} with {search.best_params_}")

    features = FunctionTransformer(functools.partial(spincat.describe, **chosen))  # type: ignore[arg-type]
    other = make_pipeline(features, LogisticRegression(C=100, max_iter=1000))
    print(f"logistic regression on its features: {np.mean(cross_val_score(other, files, labels, cv=splits)):.3f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (spincat.InputError, spincat.RunError) as problem:
        sys.exit(f"pipeline: {problem}")
