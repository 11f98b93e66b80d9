//! Our own models, as the suite fits them.

use crate::case::{Case, case};

const fn network(name: &'static str) -> Case {
    Case {
        least: 8,
        order: None,
        components: false,
        ..case(name, &["epochs=1", "batch=8"], f64::INFINITY)
    }
}

pub(crate) const CASES: &[Case] = &[
    case("baseline", &[], 5.0),
    case("ridge", &[], 0.6),
    case("pls", &[], 0.6),
    // The path ends where a sweep changes little, wherever it started.
    Case {
        order: Some(1e-3),
        ..case("elastic-net", &[], 0.9)
    },
    // Samples are compared in single precision.
    Case {
        order: Some(1e-4),
        ..case("kernel-ridge", &[], 0.4)
    },
    Case {
        order: Some(1e-4),
        ..case("gaussian-process", &[], 0.4)
    },
    Case {
        order: Some(1e-5),
        ..case("knn", &[], 1.0)
    },
    // As many values as samples: the label of the nearest picture is predicted.
    case("lda", &[], 1.5),
    Case {
        order: None,
        ..case("random-forest", &["trees=40"], 1.5)
    },
    Case {
        order: None,
        ..case("gradient-boosting", &["most=40"], 1.5)
    },
    network("cnn"),
    network("resnet10"),
    Case {
        deeper: true,
        ..network("resnet18")
    },
    Case {
        deeper: true,
        ..network("resnet34")
    },
    network("cnn-ensemble"),
    Case {
        least: 5,
        order: None,
        ..case("auto", &["budget_s=0"], 0.6)
    },
];
