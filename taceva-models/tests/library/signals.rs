//! Library models on the signals of taxels: fitted, and loaded from their file.

use taceva_core::{
    Channel, Channels, SignalInfo, Signals, SilentProgress, Targets, TrainingSet, Unit,
};
use taceva_models::{
    Extractor, FeatureSpec, FitInput, Model, ModelSettings, Models, Provenance, library_models,
};

#[test]
fn every_model_of_a_library_takes_signals() {
    let info = SignalInfo::new(3, 2, 2, Unit::Count).expect("twelve numbers");
    let sample = |number: u16| {
        let force = f32::from(number % 20);
        let values = (0..12_u16).map(|place| {
            let noise = f32::from((number * 7 + place * 3) % 5);
            500.0 + force * (f32::from(place) - 5.5) + noise
        });
        Signals::new(info, values.collect()).expect("finite")
    };
    let samples: Vec<Signals> = (0..80).map(sample).collect();
    let settings = ModelSettings::default();
    let spec = FeatureSpec::DEFAULT
        .on(&settings, None, Some(info))
        .expect("signals");
    let extractor = Extractor::new(spec, info, None).expect("fits");
    let features = extractor.extract_all(&samples).expect("one grid");
    let channels = Channels::new([Channel::FZ]).expect("one");
    let forces: Vec<f64> = (0..80_u8).map(|number| f64::from(number % 20)).collect();
    let models = Models::builtin().with_libraries(library_models());
    let mut fitted = 0;
    for info_of in models.compiled().filter(|info| info.name.contains('/')) {
        let name = info_of.name;
        let estimator = info_of.estimator(&settings).expect(name);
        let input = FitInput {
            estimator: &*estimator,
            settings: &settings,
            features: spec,
            input: info.into(),
            training: TrainingSet::new(&features, Targets::new(&channels, &forces)),
            validation: None,
            provenance: Provenance::default(),
        };
        let model = Model::fit(input, &SilentProgress).expect(name);
        let bytes = model.to_bytes().expect(name);
        let again = models.read(&bytes).expect(name);
        let found = again.predict(&features).expect(name);
        assert_eq!(found, model.predict(&features).expect(name), "{name}");
        let squares: f64 = found
            .iter()
            .zip(&forces)
            .map(|(found, force)| (found - force).powi(2))
            .sum();
        let rmse = (squares / 80.0).sqrt();
        // Forces are 0 to 19 N, with a standard deviation of 5.8 N.
        assert!(rmse < 3.0, "{name}: {rmse}");
        fitted += 1;
    }
    assert!(fitted >= 8, "{fitted} models of libraries");
}
