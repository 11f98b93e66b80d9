//! Outputs of a controller by name: their types, and the versions that have them.

/// Outputs with their types. The numbers are the first minor versions with the output, of a CB3 (3.x) and of an e-Series controller (5.x); 99 if none
/// has it.
const OUTPUTS: &[(&str, &str, [u32; 2])] = &[
    ("timestamp", "DOUBLE", [0, 0]),
    ("target_q", "VECTOR6D", [0, 0]),
    ("target_qd", "VECTOR6D", [0, 0]),
    ("target_qdd", "VECTOR6D", [0, 0]),
    ("target_current", "VECTOR6D", [0, 0]),
    ("target_moment", "VECTOR6D", [0, 0]),
    ("actual_q", "VECTOR6D", [0, 0]),
    ("actual_qd", "VECTOR6D", [0, 0]),
    ("actual_current", "VECTOR6D", [0, 0]),
    ("joint_control_output", "VECTOR6D", [0, 0]),
    ("actual_TCP_pose", "VECTOR6D", [0, 0]),
    ("actual_TCP_speed", "VECTOR6D", [0, 0]),
    ("actual_TCP_force", "VECTOR6D", [0, 0]),
    ("target_TCP_pose", "VECTOR6D", [0, 0]),
    ("target_TCP_speed", "VECTOR6D", [0, 0]),
    ("actual_digital_input_bits", "UINT64", [0, 0]),
    ("joint_temperatures", "VECTOR6D", [0, 0]),
    ("actual_execution_time", "DOUBLE", [0, 0]),
    ("robot_mode", "INT32", [0, 0]),
    ("joint_mode", "VECTOR6INT32", [0, 0]),
    ("safety_mode", "INT32", [0, 0]),
    ("safety_status", "INT32", [10, 4]),
    ("actual_tool_accelerometer", "VECTOR3D", [0, 0]),
    ("speed_scaling", "DOUBLE", [0, 0]),
    ("target_speed_fraction", "DOUBLE", [0, 0]),
    ("actual_momentum", "DOUBLE", [0, 0]),
    ("actual_main_voltage", "DOUBLE", [0, 0]),
    ("actual_robot_voltage", "DOUBLE", [0, 0]),
    ("actual_robot_current", "DOUBLE", [0, 0]),
    ("actual_joint_voltage", "VECTOR6D", [0, 0]),
    ("actual_digital_output_bits", "UINT64", [0, 0]),
    ("runtime_state", "UINT32", [0, 0]),
    ("elbow_position", "VECTOR3D", [5, 0]),
    ("elbow_velocity", "VECTOR3D", [5, 0]),
    ("robot_status_bits", "UINT32", [0, 0]),
    ("safety_status_bits", "UINT32", [10, 4]),
    ("analog_io_types", "UINT32", [0, 0]),
    ("standard_analog_input0", "DOUBLE", [0, 0]),
    ("standard_analog_input1", "DOUBLE", [0, 0]),
    ("standard_analog_output0", "DOUBLE", [0, 0]),
    ("standard_analog_output1", "DOUBLE", [0, 0]),
    ("io_current", "DOUBLE", [0, 0]),
    ("euromap67_input_bits", "UINT32", [0, 0]),
    ("euromap67_output_bits", "UINT32", [0, 0]),
    ("tool_mode", "UINT32", [0, 0]),
    ("tool_analog_input_types", "UINT32", [0, 0]),
    ("tool_analog_input0", "DOUBLE", [0, 0]),
    ("tool_analog_input1", "DOUBLE", [0, 0]),
    ("tool_output_voltage", "INT32", [0, 0]),
    ("tool_output_current", "DOUBLE", [0, 0]),
    ("tool_temperature", "DOUBLE", [0, 0]),
    ("tcp_force_scalar", "DOUBLE", [0, 0]),
    ("output_bit_registers0_to_31", "UINT32", [0, 0]),
    ("output_bit_registers32_to_63", "UINT32", [0, 0]),
    ("payload", "DOUBLE", [15, 11]),
    ("payload_cog", "VECTOR3D", [15, 11]),
    ("payload_inertia", "VECTOR6D", [15, 11]),
    ("ft_raw_wrench", "VECTOR6D", [99, 9]),
    // The recipe of a public client ends with a comma.
    ("", "DOUBLE", [0, 0]),
];
/// Registers by the start of their name, with their type and the number of registers.
const REGISTERS: [(&str, &str, u32); 4] = [
    ("output_int_register_", "INT32", 48),
    ("output_double_register_", "DOUBLE", 48),
    ("output_bit_register_", "BOOL", 128),
    ("input_int_register_", "INT32", 48),
];
/// Answer for an output that the controller lacks.
pub(super) const NOT_FOUND: &str = "NOT_FOUND";

/// Type of the output `name` of a controller of version `major.minor`; [`NOT_FOUND`] if the controller lacks the output.
pub(super) fn type_of(name: &str, [major, minor]: [u32; 2]) -> &'static str {
    let named = OUTPUTS.iter().find(|(known, ..)| *known == name);
    if let Some((_, kind, [cb3, e_series])) = named {
        let since = if major < 5 { cb3 } else { e_series };
        return if minor >= *since { kind } else { NOT_FOUND };
    }
    let register = REGISTERS.iter().find_map(|(begin, kind, end)| {
        let number: u32 = name.strip_prefix(*begin)?.parse().ok()?;
        (number < *end).then_some(*kind)
    });
    register.unwrap_or(NOT_FOUND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_that_a_version_lacks_is_not_found() {
        for (name, version, expected) in [
            ("actual_TCP_pose", [3, 8], "VECTOR6D"),
            ("safety_status_bits", [3, 8], NOT_FOUND),
            ("safety_status_bits", [3, 15], "UINT32"),
            ("safety_status_bits", [5, 4], "UINT32"),
            ("ft_raw_wrench", [3, 15], NOT_FOUND),
            ("ft_raw_wrench", [5, 11], "VECTOR6D"),
            ("output_int_register_24", [5, 11], "INT32"),
            ("output_int_register_48", [5, 11], NOT_FOUND),
            ("actual_tcp_pose", [5, 11], NOT_FOUND),
        ] {
            assert_eq!(type_of(name, version), expected, "{name}");
        }
    }
}
