#include "spincat/classify/model.h"

#include <utility>

#include "spincat/classify/model_data.h"

namespace spincat {

Model::Model(ModelData data) : data_(std::make_shared<const ModelData>(std::move(data))) {}

const Settings& Model::settings() const {
  return data_->settings;
}

const std::vector<std::string>& Model::categories() const {
  return data_->categories;
}

const std::vector<std::uint32_t>& Model::object_counts() const {
  return data_->object_counts;
}

std::uint32_t Model::meshes() const {
  return data_->kinds.meshes;
}

std::uint32_t Model::clouds() const {
  return data_->kinds.clouds;
}

const std::string& Model::dataset() const {
  return data_->dataset;
}

const std::string& Model::made_by() const {
  return data_->made_by;
}

const std::filesystem::path& Model::file() const {
  return data_->file;
}

std::size_t Model::feature_length() const {
  return data_->feature_length();
}

std::size_t Model::judge_count() const {
  return data_->judges.size();
}

bool Model::tells_strangers() const {
  return !data_->known.empty();
}

double Model::least_known() const {
  return data_->known.least;
}

}  // namespace spincat
