// SPDX-License-Identifier: Apache-2.0
// The page starts here.

window.viewer = new Viewer(new SphereTree()); // for scripts and for those who are curious
