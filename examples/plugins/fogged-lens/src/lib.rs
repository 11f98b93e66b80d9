//! The plugin `org.example.fogged-lens`: a fault of pictures.

mod estimator;

use taceva_plugin::EstimatorFactory;

taceva_plugin::export_plugin! {
    id: "org.example.fogged-lens",
    drivers: [dyn EstimatorFactory => estimator::factory],
}
