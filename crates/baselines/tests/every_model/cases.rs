//! The models of libraries, as the suite fits them.

use crate::case::{Case, case};

pub(crate) const CASES: &[Case] = &[
    case("linfa/linear", &[], 0.6),
    case("linfa/pls", &[], 0.6),
    // The descent ends where a sweep changes little.
    Case {
        order: Some(1e-3),
        ..case("linfa/elastic-net", &["strength=0.01"], 0.9)
    },
    Case {
        order: Some(1e-2),
        ..case("linfa/svr", &[], 0.6)
    },
    // As many values as samples: the label of the nearest picture is predicted.
    case("linfa/logistic", &["strength=100"], 1.5),
    case("smartcore/ridge", &["strength=0.01"], 0.6),
    Case {
        order: Some(1e-2),
        ..case("smartcore/lasso", &["strength=0.1"], 0.9)
    },
    Case {
        order: Some(1e-5),
        ..case("smartcore/knn", &[], 1.0)
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
];
