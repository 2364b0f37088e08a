//! The engine through the public interface of the library: against closed forms, plain rows of
//! springs and published tables, and in what holds for any history.

mod coating;
mod common;
mod derivatives;
mod ellipse;
mod end_of_the_table;
mod fields;
mod interface_coating;
mod interface_derivatives;
mod interface_elastic;
mod interface_running_in;
mod interface_wear;
mod invariants;
mod loops;
mod normal_contact;
mod own_states;
mod planar;
mod planar_derivatives;
mod planar_rig;
mod planar_state;
mod planar_wear;
mod problems;
mod profile_files;
mod random_wear;
mod ranges;
mod readout;
mod retune;
mod rig;
mod running_in;
mod similarity;
mod snapshot;
mod two_bodies;
mod update_jumps;
mod varying_load;
mod wear;
mod wear_depth;
