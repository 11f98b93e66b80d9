//! Tests that fewer samples than features are rejected before the library is called.

use taceva_core::{ErrorKind, SilentProgress};

use crate::every_model::case::case_of;

#[test]
fn fewer_samples_than_features_are_refused_with_the_reason() {
    let case = case_of("smartcore/svr");
    case.fitted(&case.recording(16, 7), None);
    let training = case.recording(15, 7);
    let fit = case
        .estimator()
        .fit_model(&training.set(), None, &SilentProgress);
    let error = fit.expect_err("refused");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert_eq!(
        error.to_string(),
        "15 training samples, smartcore/svr needs at least as many as there are features, 16: smartcore 0.7.0 truncates each sample to \
         that number of values. Set a smaller `size` or `pca`, or use linfa/svr"
    );
}
