//! The plugin `org.example.line-transducer`: a force transducer.

mod force;

use taceva_core::ForceTransducer;

taceva_plugin::export_plugin! {
    id: "org.example.line-transducer",
    needs: ["tcp:{host}:{port}"],
    drivers: [dyn ForceTransducer => force::factory],
}
