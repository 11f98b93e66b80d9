//! Models on disk: the same model is read back, and other files are rejected.

mod distance;
mod kept;
mod refused;
mod signals;

use taceva_core::{
    Channel, Channels, Features, Frame, FrameInfo, PixelFormat, SilentProgress, Targets,
    TrainingSet, Unit,
};
use taceva_models::{
    Color, FeatureSpec, FitInput, Model, ModelSettings, Provenance, Source, SplitCard, find,
};

pub(crate) const FRAME: FrameInfo = FrameInfo {
    width: 20,
    height: 15,
    format: PixelFormat::Rgb8,
};

pub(crate) const SPEC: FeatureSpec = FeatureSpec {
    width: 5,
    height: 4,
    color: Color::Gray,
    difference: false,
    pca: None,
    ..FeatureSpec::DEFAULT
};

/// Frames with brightness patterns that encode the labels.
pub(crate) fn frames(count: usize) -> Vec<Frame> {
    let mut state = 1_u64;
    let mut byte = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        state.to_be_bytes()[0]
    };
    (0..count)
        .map(|_| {
            let bytes = (0..20 * 15 * 3).map(|_| byte()).collect();
            Frame::new(FRAME, bytes).expect("whole")
        })
        .collect()
}

pub(crate) fn fit(name: &str, words: &[&str], spec: FeatureSpec) -> (Model, Features) {
    let frames = frames(60);
    let extractor = taceva_models::Extractor::new(spec, FRAME, None).expect("fits");
    let features = extractor.extract_all(&frames).expect("one kind");
    let channels = Channels::new([
        Channel::FZ,
        Channel::named("shear_x", Unit::Millimetre).expect("plain"),
    ])
    .expect("distinct");
    let labels: Vec<f64> = (0..60)
        .flat_map(|sample| {
            let pixels = features.sample(sample);
            [
                f64::from(pixels[3]) * 7.0 - f64::from(pixels[11]),
                f64::from(pixels[19]),
            ]
        })
        .collect();
    let rows: Vec<usize> = (0..60).collect();
    let (training, validation) = (features.select(&rows[..40]), features.select(&rows[40..]));
    let set = |features, values| TrainingSet::new(features, Targets::new(&channels, values));
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    let estimator = find(name)
        .expect("registered")
        .estimator(&settings)
        .expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features: spec,
        input: FRAME.into(),
        training: set(&training, &labels[..80]),
        validation: Some(set(&validation, &labels[80..])),
        provenance: Provenance {
            data: Some("sha256:00".into()),
            recordings: Vec::new(),
            view: None,
            source: Source::Synthetic,
            split: Some(SplitCard {
                split: "random 70/20/10".into(),
                seed: 7,
            }),
            notes: vec!["random frames".into()],
            validation: None,
            task: None,
        },
    };
    (
        Model::fit(input, &SilentProgress).expect("learnable"),
        features,
    )
}
