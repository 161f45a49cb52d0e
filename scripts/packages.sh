# The Debian 12 packages that spincat needs, by what they are needed for. Sourced by scripts/setup.
# docs/how-it-works/dependencies.md says why each library was chosen.

packages_build=(
  g++ cmake ninja-build
  libeigen3-dev        # linear algebra, Gram matrices
  libhwy-dev           # SIMD with a choice of path at run time
  libnanoflann-dev     # nearest neighbours
  libsvm-dev           # the solver of the judges' SVMs
  libtinygltf-dev      # glTF and GLB files
  liblodepng-dev       # PNG files
  libmeshoptimizer-dev # objects small enough for a report; glTF files that it has compressed
  libdraco-dev         # optional: glTF files that it has compressed
  libexpat1-dev        # 3MF files
  libjs-three          # and the script that draws them in 3D
  librsvg2-dev pkgconf # the confusion matrix as a PNG file
  nlohmann-json3-dev   # model files, JSON
  libcli11-dev         # command line
  libfmt-dev           # formatting
  zlib1g-dev           # checksums
)

packages_mpi=(
  libopenmpi-dev openmpi-bin  # many processes: mpirun, srun --mpi=pmix (docs/guide/cluster.md)
  pkgconf                     # finds every MPI that is installed
)

packages_python=(
  pybind11-dev python3-dev python3-numpy                # the package `import spincat`
  python3-pip python3-venv python3-setuptools python3-wheel  # pip install .
)

packages_camera=(
  libfreenect-dev  # optional: a Kinect as the source of spincat camera
)

packages_demo=(
  sweethome3d-furniture  # 820 furniture models, CC0 and CC-BY 3.0
  unzip
)

packages_test=(
  libgtest-dev
  clang-format-14  # whether the sources are formatted
  libfreenect-dev  # a Kinect's recording played back
  libopenmpi-dev openmpi-bin pkgconf libmpich-dev mpich  # the command under both makes of MPI
  openssh-server openssh-client iproute2                 # several hosts, as network namespaces
  strace                                                 # which files reading a model opens
  slurm-wlm munge                                        # and under srun
  "${packages_python[@]}"
  python3-sklearn  # the estimator under cross-validation, in grids and pipelines
  mypy             # the package's annotations
  zsh fish         # completions
)

# For the readers' fuzzing, which is skipped without it.
packages_fuzz=(
  clang-16 libclang-rt-16-dev  # libFuzzer and the sanitizers; 40 MB to download, 240 MB installed
)

# For the test that opens every report in a browser; it is skipped where there is none.
packages_browser=(
  chromium  # 120 MB to download, 410 MB installed
  python3
)

packages_packages=(
  libmpich-dev            # a plug-in for each MPI
  help2man dpkg-dev file  # manual pages; what a package depends on (scripts/packages)
)

packages_docs=(
  doxygen  # API documentation of the public headers
)

packages_bench=(
  python3  # prints the table; the race against PCL takes part where libpcl-dev is installed, too
)
