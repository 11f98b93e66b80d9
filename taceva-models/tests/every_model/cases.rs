//! Every registered model, with the settings of this suite.

use super::case::{Case, case};
use crate::blobs::SMALL;

const fn network(name: &'static str) -> Case {
    Case {
        least: 8,
        order: None,
        components: false,
        ..case(name, &["epochs=1", "batch=8"], f64::INFINITY)
    }
}

pub(crate) const BUILT_IN: &[Case] = &[
    Case {
        is_constant: true,
        ..case("baseline", &[], 5.0)
    },
    case("ridge", &[], 0.6),
    case("pls", &[], 0.6),
    // The path ends once a sweep changes little, for any start.
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
    // As many label values as samples: the label of the nearest picture is predicted.
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

/// Models of linfa and smartcore, if this build has both.
pub(crate) const LIBRARIES: &[Case] = match cfg!(all(feature = "linfa", feature = "smartcore")) {
    false => &[],
    true => &[
        case("linfa/linear", &[], 0.6),
        case("linfa/pls", &[], 0.6),
        // The descent ends once a sweep changes little.
        Case {
            order: Some(1e-3),
            ..case("linfa/elastic-net", &["strength=0.01"], 0.9)
        },
        Case {
            order: Some(1e-2),
            ..case("linfa/svr", &[], 0.6)
        },
        // As many label values as samples: the label of the nearest picture is predicted.
        case("linfa/logistic", &["strength=100"], 1.5),
        case("smartcore/ridge", &["strength=0.01"], 0.6),
        Case {
            order: Some(1e-2),
            ..case("smartcore/lasso", &["strength=0.1"], 0.9)
        },
        // Needs at least as many samples as features.
        Case {
            least: 16,
            order: Some(1e-2),
            blob: SMALL,
            ..case("smartcore/svr", &[], 1.0)
        },
        Case {
            order: Some(1e-5),
            ..case("smartcore/knn", &[], 1.0)
        },
        // As many label values as samples: the label of the nearest picture is predicted.
        Case {
            order: Some(1e-5),
            ..case("smartcore/knn-classifier", &[], 1.5)
        },
        Case {
            order: None,
            ..case("smartcore/random-forest", &["trees=40", "share=0.1"], 1.5)
        },
        Case {
            order: None,
            ..case("smartcore/extra-trees", &["trees=40", "share=0.1"], 1.5)
        },
        Case {
            order: None,
            ..case("smartcore/gradient-boosting", &["trees=30"], 1.5)
        },
    ],
};
