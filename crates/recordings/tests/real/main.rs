//! Recordings that lie beside the workspace; ignored where they do not.

mod bags;
mod files;
mod quality;

skipping::tests![
    bags::kobuki_wheels_currents_and_gyro_are_those_of_the_csv,
    bags::kobuki_commands_and_odometry_are_those_of_the_csv,
    bags::husky_speeds_currents_and_imu_are_those_of_the_csv,
    bags::the_contents_are_those_that_the_bags_describe,
    bags::built_in_definitions_decode_as_those_in_the_bags,
    files::every_husky_run_reads_whole_but_for_the_missing_imu,
    quality::kobuki_stamps_bursts_counters_and_steps,
    quality::husky_set_points_dead_bands_and_made_up_stamps,
    quality::drive_windows_restart_and_wheel_speeds_are_held,
    quality::robotino_steps_of_speed_and_current_and_uneven_periods,
    quality::no_good_channel_is_called_bad,
    quality::each_run_is_content_of_its_own_and_a_part_belongs_to_its_whole,
];
